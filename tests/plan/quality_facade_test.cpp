// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <numbers>
#include <vector>

#include "plan/quality/facade_quality.h"

namespace stucco::plan {
namespace {

constexpr double kMin = 10, kMax = 60;

// A level view whose direction is turned by `turn_rad` from the inverse normal, which is north.
SeenPart Part(double share, double turn_rad, double distance_m) {
  return {share, std::cos(turn_rad), {std::sin(turn_rad), std::cos(turn_rad), 0}, distance_m};
}

FacadeQuality Of(const std::vector<SeenPart>& parts, double union_share) {
  return QualityOfFacade(parts, union_share, kMin, kMax);
}

TEST(FacadeQuality, OneFrontalFullViewAtLeastDistanceIsPerfect) {
  const FacadeQuality q = Of({Part(1, 0, kMin)}, 1);
  EXPECT_DOUBLE_EQ(q.q_s, 1);
  EXPECT_DOUBLE_EQ(q.q_d, 1);
  EXPECT_DOUBLE_EQ(q.q_u, 1);
  EXPECT_DOUBLE_EQ(q.q_c, 1);
  EXPECT_DOUBLE_EQ(q.sum(), 4);
}

TEST(FacadeQuality, NoViewIsWorthNothing) {
  EXPECT_EQ(Of({}, 0).sum(), 0);
  EXPECT_EQ(Of({Part(0, 0, kMin)}, 0).sum(), 0);
}

TEST(FacadeQuality, OppositeObliqueViewsAreLessConsistentThanParallelOnes) {
  const double turn = std::numbers::pi / 4;
  const double parallel = Of({Part(0.5, turn, 20), Part(0.5, turn, 20)}, 1).q_s;
  const double opposite = Of({Part(0.5, turn, 20), Part(0.5, -turn, 20)}, 1).q_s;
  EXPECT_NEAR(parallel, 0.5 * (std::sqrt(0.5) + 1), 1e-12);
  EXPECT_NEAR(opposite, std::sqrt(0.5), 1e-12);
}

TEST(FacadeQuality, ViewsFromBehindHaveNoFrontality) {
  EXPECT_NEAR(Of({Part(1, std::numbers::pi, 20)}, 1).q_s, 0.5, 1e-12);  // consistent, at least
}

TEST(FacadeQuality, UnequalDistancesCost) {
  const double equal = Of({Part(0.5, 0, 20), Part(0.5, 0, 20)}, 1).q_d;
  const double unequal = Of({Part(0.5, 0, 10), Part(0.5, 0, 30)}, 1).q_d;
  EXPECT_NEAR(equal, 0.5 * (0.8 + 1), 1e-12);
  EXPECT_NEAR(unequal, 0.5 * (0.8 + 1 - 0.5), 1e-12);  // mean 20, deviation 10
}

TEST(FacadeQuality, OverlapCostsStructureAndGapsCostCompleteness) {
  const FacadeQuality twice = Of({Part(1, 0, 20), Part(1, 0, 20)}, 1);
  EXPECT_DOUBLE_EQ(twice.q_u, 0.5);
  EXPECT_DOUBLE_EQ(twice.q_c, 1);
  const FacadeQuality half = Of({Part(0.5, 0, 20)}, 0.5);
  EXPECT_DOUBLE_EQ(half.q_u, 1);
  EXPECT_DOUBLE_EQ(half.q_c, 0.5);
}

TEST(FacadeQuality, WeightsAreTheSharesSeen) {
  const FacadeQuality q = Of({Part(0.9, 0, 10), Part(0.1, 0, 60)}, 1);
  const double mean = 15, deviation = 15;  // sqrt(0.9 * 25 + 0.1 * 2025) = 15
  EXPECT_NEAR(q.q_d, 0.5 * (0.9 + 1 - deviation / mean), 1e-12);
}

TEST(ViewQuality, FullFrontalViewScoresTheSumOfTheWeights) {
  const FacadeQuality q = QualityOfView(Part(1, 0, kMin), 1.7, kMin, kMax);
  EXPECT_DOUBLE_EQ(ViewScore(q), 0.1 + 0.85 + 0.3 + 0.1);
}

TEST(ViewQuality, LongFacadesAskOnlyForWhatAViewCanHold) {
  const FacadeQuality q = QualityOfView(Part(0.2, 0, 20), 0.2, kMin, kMax);
  EXPECT_DOUBLE_EQ(q.q_u, 1);
  EXPECT_DOUBLE_EQ(q.q_c, 0.2);
}

TEST(Closeness, IsLinearBetweenTheLimits) {
  EXPECT_EQ(Closeness(5, kMin, kMax), 1);
  EXPECT_EQ(Closeness(35, kMin, kMax), 0.5);
  EXPECT_EQ(Closeness(100, kMin, kMax), 0);
}

}  // namespace
}  // namespace stucco::plan
