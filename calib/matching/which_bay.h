// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>

#include "calib/features/wall_features.h"

namespace stucco {

// What two photos show of a wall, each where its pose puts it.
struct BayQuestion {
  const WallKeypoints& first;
  const WallKeypoints& second;
  double sigma_m = 0;  // of the shift between the two, along the wall or up
  std::function<bool(const Eigen::Vector2d&)> second_shows;  // a place along the wall and up
};

// Places on the wall (along, up, 1) by the first photo's pose to those by the second's.
using WallFromWall = Eigen::Matrix<double, 2, 3>;

// Bays that look alike are seldom the same: curtains, stains and what stands before them differ.
// So the shift at which most keypoints have their like is held against every other that many have
// theirs at, each fitted by itself: each keypoint that both put into the second picture sides with
// the one where its like is clearly nearer. Nothing unless four in five side with one shift against
// each of the others: between bays that are the same to the texel keypoints are of two minds. And
// nothing farther off than poses of that standard deviation are.
std::optional<WallFromWall> TellBay(const BayQuestion& question);

}  // namespace stucco
