// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "calib/scene/scene.h"
#include "calib/scene/tracks.h"
#include "calib/two_view/verify.h"

namespace stucco {

// A verified pair of photos and what kind of motion lies between them.
struct VerifiedPair {
  PhotoPair pair;
  PairGeometry geometry;
  // One rotation explains the matches as well as an epipolar geometry does: no depth can come from
  // it.
  bool rotation_only = false;
};

// Sets `rotation_only`, with the cameras as the scene has them. Matches count within
// `max_error_sigmas` standard deviations of the keypoints.
void ClassifyMotion(const Scene& scene, double max_error_sigmas, VerifiedPair& pair);

// Groups of at least three photos tied together by rotation-only pairs: panoramas from one point.
// Pairs whose photos the scene has registered at clearly different places (more than half a degree
// apart as seen from what both show) do not count: over a distant or flat scene a small step looks
// like a rotation. Each group ascending, groups by their first photo.
std::vector<std::vector<int>> RotationGroups(const Scene& scene,
                                             const std::vector<VerifiedPair>& pairs);

struct InitialPair {
  int first = 0;
  int second = 0;
  RelativePose relative;
};

// Pairs to start from, best first: many matches under a good angle that no rotation explains.
// At most `max_initial_pairs`.
std::vector<InitialPair> FindInitialPairs(const Scene& scene,
                                          const std::vector<VerifiedPair>& pairs,
                                          double max_error_sigmas, int max_initial_pairs);

}  // namespace stucco
