// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/map/wall_tops.h"

#include <gtest/gtest.h>

namespace stucco {
namespace {

using Eigen::Vector3d;

// A tower of 16 x 16 m on the ground z = 0; `fitted`: whether its edges are held by points.
FittedBuilding Tower(bool fitted) {
  FittedBuilding building;
  building.building.parts = {Polygon{{{{0, 0}, {16, 0}, {16, 16}, {0, 16}}}}};
  building.edges.resize(4);
  building = WithParts(std::move(building), building.building.parts);
  for (FittedEdge& edge : building.edges) edge.fitted = fitted;
  return building;
}

// Samples of its walls up to a height by edge, three a metre.
Samples WallsUpTo(const FittedBuilding& building, const std::vector<double>& heights) {
  Samples samples;
  for (size_t e = 0; e < building.edges.size(); ++e) {
    const Segment2d& line = building.edges[e].line;
    const Eigen::Vector2d outwards = OutwardsOf(line);
    for (double along = 0.1; along < 16; along += 1.0 / 3) {
      const Eigen::Vector2d at = line.a + along / 16 * (line.b - line.a);
      for (double z = 0.2; z <= heights[e]; z += 1.0 / 3) {
        samples.positions.emplace_back(at.x(), at.y(), z);
        samples.normals.emplace_back(outwards.x(), outwards.y(), 0);
        samples.weights.push_back(1);
        samples.cameras.push_back(-1);
      }
    }
  }
  return samples;
}

TEST(WallTops, WhatLiesBelowThemIsNoRoof) {
  const FittedBuilding tower = Tower(true);
  const WallTops tops(tower, WallsUpTo(tower, {60, 60, 60, 60}), 0.3);
  EXPECT_TRUE(tops.IsBelow({1, 8, 30}));  // the floor of a loggia
  EXPECT_TRUE(tops.IsBelow({8, 8, 30}));
  EXPECT_FALSE(tops.IsBelow({8, 8, 59}));    // a roof behind a parapet
  EXPECT_FALSE(tops.IsBelow({8, 8, 52.5}));  // one that falls to a valley
  EXPECT_FALSE(tops.IsBelow({1, 8, 57}));
  ASSERT_TRUE(tops.Height());
  EXPECT_NEAR(*tops.Height(), 60, 0.4);
}

TEST(WallTops, ALowerPartHasLowerWalls) {
  const FittedBuilding tower = Tower(true);
  const WallTops tops(tower, WallsUpTo(tower, {6, 60, 60, 60}), 0.3);
  EXPECT_FALSE(tops.IsBelow({8, 1, 6}));  // a hall at its foot, beside its own wall
  EXPECT_TRUE(tops.IsBelow({8, 15, 6}));
}

TEST(WallTops, StraysAboveAWallAreNoneOfIt) {
  const FittedBuilding tower = Tower(true);
  Samples samples = WallsUpTo(tower, {20, 20, 20, 20});
  for (int k = 0; k < 5; ++k) {  // a mast
    samples.positions.emplace_back(8, 0, 24 + 3 * k);
    samples.normals.emplace_back(0, -1, 0);
    samples.weights.push_back(1);
    samples.cameras.push_back(-1);
  }
  const WallTops tops(tower, samples, 0.3);
  EXPECT_FALSE(tops.IsBelow({8, 1, 18}));
  EXPECT_NEAR(tops.Height().value_or(0), 20, 0.4);
}

TEST(WallTops, NothingIsKnownWhereNoWallWasSeen) {
  const FittedBuilding tower = Tower(false);
  const WallTops tops(tower, WallsUpTo(tower, {60, 60, 60, 60}), 0.3);
  EXPECT_FALSE(tops.IsBelow({8, 8, 3}));
  EXPECT_FALSE(tops.Height());
}

}  // namespace
}  // namespace stucco
