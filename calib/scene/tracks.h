// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "calib/features/match.h"
#include "calib/scene/scene.h"

namespace stucco {

// Verified matches between two photos, by index.
struct PhotoPair {
  int first = 0;
  int second = 0;
  std::vector<Match> matches;
};

// Joins matches to tracks (union-find). Pairs with many matches go first, and a match that would
// put two keypoints of one photo into the same track is refused, so that one wrong match cannot
// glue two tracks together. Tracks and their elements come in ascending order of (photo, keypoint).
// Pairs come by pointer, as their owners keep them within something larger. Requires matches of
// keypoints that there are, and no more keypoints than an int can number.
std::vector<SceneTrack> BuildTracks(const std::vector<size_t>& num_keypoints,
                                    std::vector<const PhotoPair*> pairs);

// Fills Scene::tracks_of_photo from Scene::tracks.
void IndexTracks(Scene& scene);

}  // namespace stucco
