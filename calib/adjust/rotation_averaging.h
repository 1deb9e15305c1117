// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <vector>

namespace stucco {

struct RelativeRotation {
  int first = 0;
  int second = 0;
  Eigen::Quaterniond second_from_first = Eigen::Quaterniond::Identity();
};

struct RotationSigmas {
  double relative_rad = 0.01;
  double prior_rad = 0.01;
};

// Rotations (cam_from_world) nearest to the relative ones and to their own priors, which are also
// the start: least squares with Cauchy loss at three standard deviations of both. Things without a
// prior keep none. Requires that pairs have priors.
void AverageRotations(const std::vector<RelativeRotation>& pairs, const RotationSigmas& sigmas,
                      std::vector<std::optional<Eigen::Quaterniond>>& rotations);

}  // namespace stucco
