// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <vector>

#include "calib/features/wall_features.h"

namespace stucco {

// Of the shift on a wall between what two poses show there: more is no error of theirs.
inline constexpr double kReachSigmas = 3.5;

// What a photo shows of a wall and what others do, each where its pose puts it.
struct BayQuestion {
  const WallKeypoints& first;
  std::vector<const WallKeypoints*> others;
  // Of the shift between the first and the others, along the wall and up.
  Eigen::Vector2d sigma_m = Eigen::Vector2d::Zero();
  std::function<bool(const Eigen::Vector2d&)> others_show;  // a place along the wall and up
};

// Places on the wall (along, up, 1) by the first photo's pose to those by the second's.
using WallFromWall = Eigen::Matrix<double, 2, 3>;

struct ToldBay {
  WallFromWall from;
  // How much more keypoints say than is asked for: their odds against the worst rival, as a power
  // of the odds asked for. At least 1.
  double sureness = 1;
};

// Bays that look alike are seldom the same: curtains, stains and what stands before them differ.
// So every shift that brings many keypoints onto their like is a candidate, each fitted by itself
// with the scale that goes with it: each keypoint that two of them put where the others show the
// wall sides with the one where its like is clearly nearer, unless the others show the same at both
// places: what differs then is where bays are seen from. Nothing unless four in five side with one
// shift against each of the others, or as many fewer as the poses speak for it: between bays that
// are the same to the texel keypoints are of two minds. What poses of these standard deviations
// rule out is not told, and no rival where it is much farther off than what is: a pose that is off
// by more than it should be is told nothing rather than the bay on its other side.
std::optional<ToldBay> TellBay(const BayQuestion& question);

}  // namespace stucco
