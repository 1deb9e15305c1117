// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <numbers>
#include <vector>

#include "calib/records/records.h"
#include "tests/calib/made_scene.h"

namespace stucco::test {

inline constexpr double kDegree = std::numbers::pi / 180;

struct MadeRecordErrors {
  double position_sigma_m = 0.5;
  double attitude_sigma_rad = 0.003;
  Eigen::Vector3d mount_rad = Eigen::Vector3d::Zero();
  std::vector<double> yaw_rad = {0};                                 // by flight
  std::vector<Eigen::Vector3d> shift_m = {Eigen::Vector3d::Zero()};  // by flight
  uint32_t seed = 7;
};

// What receivers and gimbals that err so would have written of a scene's poses; photos change
// flights one after the other.
std::vector<PoseRecord> MakeRecords(const Scene& truth, const MadeRecordErrors& errors);

// Poses and points, counter-clockwise as seen from above.
void TurnAboutUp(double angle_rad, Scene& scene);

}  // namespace stucco::test
