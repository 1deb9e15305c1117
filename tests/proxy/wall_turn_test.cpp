// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/map/wall_turn.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace stucco {
namespace {

// Points of a wall `distance` outwards of the middle of an edge, from one place along it to
// another.
void Add(double distance, double turn, double from, double to, std::vector<WallHit>& hits) {
  std::mt19937 dice(7);
  std::normal_distribution<double> noise(0, 0.02);
  constexpr int kCount = 800;
  for (int k = 0; k < kCount; ++k) {
    const double along = from + (to - from) * (k + 0.5) / kCount;
    hits.push_back({.distance = distance - turn * along + noise(dice), .cell = {}, .along = along});
  }
  std::ranges::sort(hits, {}, &WallHit::distance);
}

TEST(WallTurn, IsThatOfTheLineThatMostPointsLieOn) {
  for (const double turn : {-0.012, 0.0, 0.005}) {
    std::vector<WallHit> hits;
    Add(0.4, turn, -20, 20, hits);
    Add(-0.6, 0.02, -20, -5, hits);  // something else
    const WallTurn found = TurnAmong(hits, {}, 40);
    EXPECT_NEAR(found.turn, turn, 0.0011) << turn;
    EXPECT_GT(found.span, 30) << turn;
  }
}

TEST(WallTurn, IsNotMadeOfTwoLinesThatAreAlongTheEdge) {
  std::vector<WallHit> hits;
  Add(0, 0, -5, 5, hits);
  Add(-0.15, 0, -5, -1, hits);  // windows at one end
  EXPECT_NEAR(TurnAmong(hits, {}, 10).turn, 0, 0.002);
}

TEST(WallTurn, SpanIsOfThePoints) {
  std::vector<WallHit> hits;
  Add(0, 0, 10, 14, hits);
  EXPECT_NEAR(TurnAmong(hits, {}, 40).span, 4, 0.1);
  EXPECT_EQ(TurnAmong({}, {}, 40).span, 0);
}

TEST(WallTurn, TurnedPointsLieAlongTheEdge) {
  std::vector<WallHit> hits;
  Add(0.4, 0.012, -20, 20, hits);
  const auto turned = Turned(hits, 0.012);
  ASSERT_EQ(turned.size(), hits.size());
  EXPECT_GT(turned.front().distance, 0.3);
  EXPECT_LT(turned.back().distance, 0.5);
  EXPECT_TRUE(std::ranges::is_sorted(turned, {}, &WallHit::distance));
}

}  // namespace
}  // namespace stucco
