// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "tests/plan/pair_reconstructability.h"

namespace stucco::plan {
namespace {

const Eigen::Vector3d kUp = Eigen::Vector3d::UnitZ();
const Eigen::Vector3d kOrigin = Eigen::Vector3d::Zero();

// At an angle from the vertical, towards the east.
Eigen::Vector3d At(double distance_m, double angle_rad) {
  return distance_m * Eigen::Vector3d(std::sin(angle_rad), 0, std::cos(angle_rad));
}

TEST(Reconstructability, ParallaxIsWantedFromAboutElevenDegrees) {
  EXPECT_NEAR(ParallaxWeight(std::numbers::pi / 16), 0.5, 1e-12);
  EXPECT_NEAR(ParallaxWeight(0), 1 / (1 + std::exp(2 * std::numbers::pi)), 1e-12);
  EXPECT_GT(ParallaxWeight(std::numbers::pi / 8), 0.99);
}

TEST(Reconstructability, PhotosAreMatchableUpToAboutFortyFiveDegrees) {
  EXPECT_NEAR(MatchWeight(std::numbers::pi / 4), 0.5, 1e-12);
  EXPECT_GT(MatchWeight(0), 0.99);
  EXPECT_LT(MatchWeight(std::numbers::pi / 2), 0.01);
}

TEST(Reconstructability, ResolutionFallsToNothingAtTheLargestDistance) {
  EXPECT_EQ(ResolutionWeight(0, 80), 1);
  EXPECT_EQ(ResolutionWeight(20, 80), 0.75);
  EXPECT_EQ(ResolutionWeight(80, 80), 0);
  EXPECT_EQ(ResolutionWeight(200, 80), 0);
}

TEST(Reconstructability, IsBestAtAboutTwentyDegreesOfParallax) {
  double best = 0, best_angle = 0;
  for (double angle = 0; angle < std::numbers::pi / 2; angle += 0.005) {
    const double q =
        PairReconstructability(kOrigin, kUp, At(30, -angle / 2), At(30, angle / 2), 100);
    if (q > best) {
      best = q;
      best_angle = angle;
    }
  }
  EXPECT_NEAR(best_angle * 180 / std::numbers::pi, 20, 3);
}

TEST(GoodPair, IsAPairWithTheNormalBetweenItsRays) {
  const double incidence = 8.66 * std::numbers::pi / 180;
  EXPECT_NEAR(GoodPair(30, 100),
              PairReconstructability(kOrigin, kUp, At(30, -incidence), At(30, incidence), 100),
              1e-12);
  EXPECT_EQ(GoodPair(100, 100), 0);
}

}  // namespace
}  // namespace stucco::plan
