// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulate/city/footprints.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "survey/geometry2d.h"

namespace stucco::simulate {
namespace {

TEST(Footprints, HaveTheAreasOfTheirShapes) {
  EXPECT_DOUBLE_EQ(Area(Rectangle(8, 5)), 40);
  EXPECT_DOUBLE_EQ(Area(LShape(12, 10, 4)), 12 * 4 + 4 * 6);
  EXPECT_DOUBLE_EQ(Area(UShape(12, 10, 3)), 12 * 3 + 2 * 3 * 7);
  EXPECT_DOUBLE_EQ(Area(TShape(12, 10, 4)), 12 * 4 + 4 * 6);
  EXPECT_DOUBLE_EQ(Area(CourtyardShape(20, 16, 5)), 20 * 16 - 10 * 6);
  EXPECT_DOUBLE_EQ(Area(CrossShape(12, 10, 2)), 120 - 16);
}

TEST(Footprints, KeepAreaAndSenseWhenTurnedAndMirrored) {
  const Polygon shape = CourtyardShape(20, 16, 5);
  const Polygon placed = Placed(Mirrored(shape), 0.7, {100, -30});
  EXPECT_NEAR(Area(placed), Area(shape), 1e-9);
  EXPECT_GT(SignedArea(placed.rings[0]), 0);
  EXPECT_LT(SignedArea(placed.rings[1]), 0);
}

TEST(Footprints, GapIsTheDistanceBetweenWalls) {
  const Polygon a = Rectangle(10, 10);
  EXPECT_NEAR(Gap(a, Placed(Rectangle(10, 10), 0, {13, 2})), 3, 1e-12);
  EXPECT_NEAR(Gap(a, Placed(Rectangle(10, 10), 0, {13, 14})), 5, 1e-12);
}

TEST(Footprints, GapOfTouchingOnesIsZero) {
  EXPECT_NEAR(Gap(Rectangle(10, 10), Placed(Rectangle(10, 10), 0, {10, 3})), 0, 1e-12);
}

TEST(Footprints, GapIsNegativeForOverlaps) {
  const Polygon a = Rectangle(10, 10);
  EXPECT_LT(Gap(a, Placed(a, 0.3, {7, 0})), 0);
  EXPECT_LT(Gap(a, a), 0);
  EXPECT_LT(Gap(a, Rectangle(2, 2)), 0);                       // inside, far from the walls
  EXPECT_LT(Gap(Rectangle(20, 2), Rectangle(2, 20)), 0);       // a cross
  EXPECT_LT(Gap(a, Placed(Rectangle(10, 10), 0, {5, 0})), 0);  // walls on the same lines
}

TEST(Footprints, ABuildingInACourtyardDoesNotOverlap) {
  EXPECT_NEAR(Gap(CourtyardShape(40, 40, 8), Rectangle(10, 10)), 7, 1e-12);
}

TEST(Footprints, OffsetMovesEveryWallByItsOwnDistance) {
  const Ring moved = Offset(Rectangle(10, 6).rings[0], {1, 0, 2, 0.5});
  EXPECT_NEAR(SignedArea(moved), 10.5 * 9, 1e-12);
  EXPECT_NEAR((moved[0] - Eigen::Vector2d(-5.5, -4)).norm(), 0, 1e-12);
}

}  // namespace
}  // namespace stucco::simulate
