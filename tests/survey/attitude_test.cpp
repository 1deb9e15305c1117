// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/attitude.h"

#include <gtest/gtest.h>

#include <numbers>

namespace stucco {
namespace {

using Eigen::Vector3d;

void ExpectNear(const Vector3d& actual, const Vector3d& expected) {
  EXPECT_LT((actual - expected).norm(), 1e-12) << actual.transpose();
}

TEST(CamFromEnu, OfALevelCameraLooksAlongItsYaw) {
  const Eigen::Quaterniond north = CamFromEnu({0, 0, 0});
  ExpectNear(north * Vector3d::UnitY(), Vector3d::UnitZ());  // forward
  ExpectNear(north * Vector3d::UnitX(), Vector3d::UnitX());  // right
  ExpectNear(north * Vector3d::UnitZ(), -Vector3d::UnitY());
  const Eigen::Quaterniond east = CamFromEnu({90, 0, 0});
  ExpectNear(east * Vector3d::UnitX(), Vector3d::UnitZ());
  ExpectNear(east * -Vector3d::UnitY(), Vector3d::UnitX());
}

TEST(CamFromEnu, OfANadirPhotoKeepsTheYawAsTheTopOfThePicture) {
  const Eigen::Quaterniond down = CamFromEnu({90, -90, 0});
  ExpectNear(down * -Vector3d::UnitZ(), Vector3d::UnitZ());
  ExpectNear(down * Vector3d::UnitX(), -Vector3d::UnitY());
}

TEST(CamFromEnu, TiltsAndRolls) {
  const Eigen::Quaterniond tilted = CamFromEnu({0, -30, 0});
  ExpectNear(tilted * Vector3d(0, std::cos(std::numbers::pi / 6), -0.5), Vector3d::UnitZ());
  // Rolled clockwise, the horizon's right end is above the picture's middle.
  const Vector3d right = CamFromEnu({0, 0, 10}) * Vector3d::UnitX();
  EXPECT_LT(right.y(), 0);
  EXPECT_NEAR(right.x(), std::cos(10 * std::numbers::pi / 180), 1e-12);
}

TEST(WrappedDegrees, EndsAtHalfATurn) {
  EXPECT_EQ(WrappedDegrees(-180), 180);
  EXPECT_EQ(WrappedDegrees(540), 180);
  EXPECT_EQ(WrappedDegrees(190), -170);
  EXPECT_EQ(WrappedDegrees(-370), -10);
}

TEST(AngleBetween, IsExactWhereCosinesAreNot) {
  EXPECT_DOUBLE_EQ(AngleBetween({3, 0, 0}, {0, 0, 2}), std::numbers::pi / 2);
  EXPECT_DOUBLE_EQ(AngleBetween({1, 0, 0}, {-2, 0, 0}), std::numbers::pi);
  EXPECT_NEAR(AngleBetween({1, 0, 0}, {1, 1e-9, 0}), 1e-9, 1e-15);
  EXPECT_EQ(AngleBetween({1, 2, 3}, {0, 0, 0}), 0);
}

}  // namespace
}  // namespace stucco
