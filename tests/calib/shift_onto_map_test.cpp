// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/records/shift_onto_map.h"

#include <gtest/gtest.h>

#include <vector>

#include "tests/calib/made_scene.h"
#include "tests/site/made_plan.h"

namespace stucco::test {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

SiteMap MapOfTwoHouses() {
  const Plan plan = TwoHouses();
  return {plan.facades, plan.footprints};
}

void AddPointsOn(const PlannedFacade& wall, int number, Random& random,
                 std::vector<Vector3d>& points) {
  for (int i = 0; i < number; ++i) {
    const Vector2d level = wall.a_m + random.Uniform(0, wall.length_m()) * wall.along();
    points.emplace_back(level.x(), level.y(), random.Uniform(wall.z_m.from_m, wall.z_m.to_m));
  }
}

std::vector<Vector3d> OnAllWalls(const SiteMap& map) {
  std::vector<Vector3d> points;
  Random random(3);
  for (const PlannedFacade& wall : map.walls) AddPointsOn(wall, 100, random, points);
  return points;
}

// As high as the houses, over all of them.
void AddRoofs(const SiteMap& map, std::vector<Vector3d>& points) {
  Random random(4);
  for (const PlannedFootprint& footprint : map.footprints) {
    const Vector2d& a = footprint.rings_m[0][0];
    const Vector2d& c = footprint.rings_m[0][2];
    for (int i = 0; i < 2000; ++i) {
      points.emplace_back(random.Uniform(a.x(), c.x()), random.Uniform(a.y(), c.y()),
                          footprint.z_m.to_m);
    }
  }
}

void Shift(const Vector2d& shift, std::vector<Vector3d>& points) {
  for (Vector3d& point : points) point.head<2>() += shift;
}

TEST(ShiftOntoMap, BringsPointsBack) {
  const SiteMap map = MapOfTwoHouses();
  for (const Vector2d& off : {Vector2d(1.3, -0.7), Vector2d(-4.1, 3.2), Vector2d(0, 0)}) {
    std::vector<Vector3d> walls = OnAllWalls(map);
    std::vector<Vector3d> with_roofs = walls;
    AddRoofs(map, with_roofs);
    Shift(off, walls);
    Shift(off, with_roofs);
    EXPECT_LT((ShiftOntoMap(walls, map) + off).norm(), 0.1);
    EXPECT_LT((ShiftOntoMap(with_roofs, map) + off).norm(), 0.1);
  }
}

TEST(ShiftOntoMap, LeavesPointsThatLieOnNoWall) {
  const SiteMap map = MapOfTwoHouses();
  std::vector<Vector3d> points = OnAllWalls(map);
  Shift({200, 0}, points);
  EXPECT_EQ(ShiftOntoMap(points, map), Vector2d(0, 0));
  EXPECT_EQ(ShiftOntoMap({}, map), Vector2d(0, 0));
  std::vector<Vector3d> roofs;
  AddRoofs(map, roofs);
  Shift({1, 0}, roofs);
  EXPECT_EQ(ShiftOntoMap(roofs, map), Vector2d(0, 0));
}

// Only one wall shows, and a fence before it: walls alone cannot tell which of them it is.
TEST(ShiftOntoMap, GoesByTheRoofsWhereFewWallsShow) {
  SiteMap map = MapOfTwoHouses();
  const PlannedFacade& wall = map.walls[0];
  std::vector<Vector3d> points;
  Random random(5);
  AddPointsOn(wall, 300, random, points);
  PlannedFacade fence = wall;
  fence.a_m += 4 * wall.outwards();
  fence.b_m += 4 * wall.outwards();
  AddPointsOn(fence, 400, random, points);
  const Vector2d onto_fence = ShiftOntoMap(points, map);
  EXPECT_NEAR(onto_fence.dot(wall.outwards()), -4, 0.1);
  AddRoofs(map, points);
  EXPECT_NEAR(ShiftOntoMap(points, map).dot(wall.outwards()), 0, 0.1);
}

}  // namespace
}  // namespace stucco::test
