// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "calib/features/wall_features.h"
#include "calib/matching/detect_photos.h"
#include "calib/matching/photo_set.h"
#include "survey/pose.h"

namespace stucco {

// How what one photo shows of a wall looks like itself, shifted.
struct WallRepeats {
  double share = 0;     // of the keypoints that look the same a common shift farther
  double period_m = 0;  // the shortest of these shifts; 0: there is none
};

// Keypoints are alike when their descriptors differ less than those of one place in two photos
// usually do, on a rectified wall, where bays look the same from wherever they are seen. Shifts
// from one to ten metres are looked at, and count where several keypoints have them in common.
WallRepeats FindRepeats(const WallKeypoints& wall);

// Walls that repeat themselves exactly, with their periods in metres: in the middle one of the
// photos that show most of a wall, a good part of it looks the same a common shift farther. Real
// walls, whose bays differ in stains, curtains and what stands before them, are not among them.
std::map<int, double> FindRepeatingWalls(const DetectInput& input,
                                         const DetectedFeatures& features);

// Keypoints that show walls that repeat themselves: a match of one may be a bay or a storey off.
struct OnRepeatingWalls {
  std::map<int, double> period_m;         // by wall: as FindRepeatingWalls gives it
  std::vector<std::vector<int>> wall_of;  // by photo and keypoint found in the photo itself: -1 for
                                          // none; empty where the photo shows no such wall
  // By photo: from which keypoint to before which were found on such walls rectified.
  std::vector<std::vector<std::pair<size_t, size_t>>> rectified;

  // Not those of rectified walls, which come after the photo's own.
  bool Shows(int photo, int keypoint) const {
    const std::vector<int>& walls = wall_of[photo];
    return keypoint < static_cast<int>(walls.size()) && walls[keypoint] >= 0;
  }
  // Those, too.
  bool IsOnOne(int photo, int keypoint) const;
  // At least half of what is found in the photo lies on such walls.
  bool IsMostOf(int photo) const;
};

// From where the photos should be by their records, and a little beyond the walls' edges: these are
// off.
OnRepeatingWalls FindOnRepeatingWalls(const DetectInput& input, const DetectedFeatures& features);

// The same from where photos turned out to be, which may be metres beside their records: of those
// that have a pose here, cam_from_plan.
void LookAgain(const DetectInput& input, const DetectedFeatures& features,
               const std::vector<std::optional<Pose>>& poses, OnRepeatingWalls& repeating);

}  // namespace stucco
