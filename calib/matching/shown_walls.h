// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "calib/features/wall_features.h"
#include "calib/matching/known_poses.h"
#include "calib/matching/match_photos.h"

namespace stucco {

struct AgainInput {
  const CalibOptions& options;
  const PhotoSet& set;
  const DetectedFeatures& features;
  const OnRepeatingWalls& repeating;
  const std::vector<std::optional<KnownPose>>& poses;  // by photo
  const StageContext& context;
};

// What a photo shows of one wall, where its pose puts it.
struct Shown {
  WallKeypoints on_wall;
  std::vector<int32_t> of_photo;  // their numbers among all of the photo's keypoints
  double distance_m = 0;          // of the middle of the wall
};

using ShownWalls = std::map<int, Shown>;

// Of the walls that repeat themselves: the photo's own keypoints and those found in its rectified
// pictures of walls. Nothing of walls with hardly a keypoint. Safe to ask from several threads.
ShownWalls ShowWalls(const AgainInput& input, int photo);

// Whether the photo's pose lets it show a place of the wall, along it and up.
bool ShowsPlace(const AgainInput& input, int photo, int wall, const Eigen::Vector2d& place);

// What relief and the map add to places on a wall, one standard deviation, metres.
inline constexpr double kOffWall_m = 0.2;

// Variances, along the wall and up, of where a pose puts what it shows at that distance, without
// kOffWall_m.
Eigen::Vector2d PlaceVariances(const KnownPose& pose, double distance_m);

}  // namespace stucco
