// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/camera/hover.h"

#include <gtest/gtest.h>

#include <numbers>

namespace stucco::plan {
namespace {

TEST(Shot, YawTurnsClockwiseFromNorth) {
  const Shot east{.yaw_rad = std::numbers::pi / 2, .targets = {}};
  EXPECT_NEAR((east.Direction() - Eigen::Vector3d(1, 0, 0)).norm(), 0, 1e-12);
}

TEST(Shot, NegativePitchLooksDown) {
  const Shot tilted{.yaw_rad = 0, .pitch_rad = -std::numbers::pi / 4, .targets = {}};
  const double half = std::sqrt(0.5);
  EXPECT_NEAR((tilted.Direction() - Eigen::Vector3d(0, half, -half)).norm(), 0, 1e-12);
}

}  // namespace
}  // namespace stucco::plan
