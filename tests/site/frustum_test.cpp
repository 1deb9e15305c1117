// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "site/frustum.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace stucco {
namespace {

// 60 degrees wide, 40 high.
Frustum Looking(double yaw_rad, double pitch_rad) {
  return LevelFrustum({std::tan(std::numbers::pi / 6), std::tan(std::numbers::pi / 9)}, {1, 2, 30},
                      yaw_rad, pitch_rad, 100);
}

TEST(Frustum, EndsAtTheFieldOfView) {
  const Frustum east = Looking(std::numbers::pi / 2, 0);
  const auto at = [&](double right_rad, double up_rad) {
    return Eigen::Vector3d(1 + 10, 2 - 10 * std::tan(right_rad), 30 + 10 * std::tan(up_rad));
  };
  const double degree = std::numbers::pi / 180;
  EXPECT_TRUE(east.Contains(at(0, 0)));
  EXPECT_TRUE(east.Contains(at(29.9 * degree, 19.9 * degree)));
  EXPECT_TRUE(east.Contains(at(-29.9 * degree, -19.9 * degree)));
  EXPECT_FALSE(east.Contains(at(30.1 * degree, 0)));
  EXPECT_FALSE(east.Contains(at(-30.1 * degree, 0)));
  EXPECT_FALSE(east.Contains(at(0, 20.1 * degree)));
  EXPECT_FALSE(east.Contains(at(0, -20.1 * degree)));
}

TEST(Frustum, EndsAtItsReachAndBehindTheCamera) {
  const Frustum east = Looking(std::numbers::pi / 2, 0);
  EXPECT_TRUE(east.Contains({1 + 99.9, 2, 30}));
  EXPECT_FALSE(east.Contains({1 + 100.1, 2, 30}));
  EXPECT_FALSE(east.Contains({1 - 10, 2, 30}));
  EXPECT_FALSE(east.Contains({1, 2, 30}));
}

TEST(Frustum, LookingDownTheYawIsTheTopOfThePicture) {
  const Frustum down = Looking(0, -std::numbers::pi / 2);
  EXPECT_NEAR((down.down - Eigen::Vector3d(0, -1, 0)).norm(), 0, 1e-12);
  EXPECT_TRUE(down.Contains({1 + 17, 2, 0}));   // half a width is 30 tan(30) = 17.3 m
  EXPECT_FALSE(down.Contains({1, 2 + 17, 0}));  // half a height is 10.9 m
  EXPECT_TRUE(down.Contains({1, 2 + 10.5, 0}));
}

TEST(Frustum, NoBoxWithAPointInThePictureIsLeftOut) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(0, 1);
  int out = 0;
  for (int i = 0; i < 20000; ++i) {
    const Frustum frustum =
        Looking(2 * std::numbers::pi * unit(random), -0.5 * std::numbers::pi * unit(random));
    const auto point = [&] {
      return Eigen::Vector3d(240 * unit(random) - 120, 240 * unit(random) - 120, 60 * unit(random));
    };
    const Eigen::Vector3d low = point();
    const Eigen::Vector3d size = 20 * Eigen::Vector3d(unit(random), unit(random), unit(random));
    const bool may = frustum.MayTouch(low, low + size);
    out += !may;
    for (int k = 0; k < 20; ++k) {
      const Eigen::Vector3d share(unit(random), unit(random), unit(random));
      EXPECT_LE(frustum.Contains(low + size.cwiseProduct(share)), may);
    }
  }
  EXPECT_GT(out, 10000);  // most boxes are elsewhere, and cost nothing
}

}  // namespace
}  // namespace stucco
