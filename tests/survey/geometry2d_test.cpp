// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/geometry2d.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace stucco {
namespace {

Polygon WithCourtyard() {
  return {{{{0, 0}, {10, 0}, {10, 8}, {0, 8}}, {{3, 3}, {3, 5}, {6, 5}, {6, 3}}}};
}

TEST(Geometry2d, CrossIsPositiveToTheLeft) {
  EXPECT_EQ(Cross({2, 0}, {0, 3}), 6);
  EXPECT_EQ(Cross({0, 3}, {2, 0}), -6);
  EXPECT_EQ(Cross({2, 1}, {4, 2}), 0);
}

TEST(Geometry2d, ALevelMotionsRowsAreItsDerivatives) {
  const LevelMotion motion{.center = {3, -2}, .shift = {0.7, 1.1}, .turn_rad = 0.3};
  const Eigen::Vector2d place(10, 5), n(0.6, -0.8);
  const Eigen::Vector2d moved = motion.Transform() * place;
  EXPECT_LT((motion.Transform() * motion.center - motion.center - motion.shift).norm(), 1e-12);
  EXPECT_GT(Cross(place - motion.center, moved - motion.center - motion.shift), 0);  // to the left
  const Eigen::Vector3d row = motion.RowOf(n, moved);
  constexpr double kStep = 1e-6;
  for (int i = 0; i < 3; ++i) {
    LevelMotion farther = motion;
    if (i < 2) farther.shift[i] += kStep;
    if (i == 2) farther.turn_rad += kStep;
    EXPECT_NEAR(row[i], n.dot(farther.Transform() * place - moved) / kStep, 1e-5);
  }
}

TEST(Geometry2d, AreasTellTheDirectionOfARing) {
  const Polygon polygon = WithCourtyard();
  EXPECT_EQ(SignedArea(polygon.rings[0]), 80);
  EXPECT_EQ(SignedArea(polygon.rings[1]), -6);
  EXPECT_EQ(Area(polygon), 74);
  EXPECT_EQ(SignedArea({{0, 0}, {1, 1}}), 0);
  EXPECT_EQ(SignedArea({}), 0);
}

// A square millimetre at the edge of a state.
TEST(Geometry2d, AreasKeepTheirDigitsFarFromTheOrigin) {
  const double x = 4e6;
  EXPECT_NEAR(SignedArea({{x, x}, {x + 0.5, x}, {x + 0.5, x + 0.25}, {x, x + 0.25}}), 0.125, 1e-9);
}

TEST(Geometry2d, BoundsAreThoseOfTheOuterRing) {
  const Eigen::AlignedBox2d bounds = BoundsOf(WithCourtyard());
  EXPECT_EQ(bounds.min(), Eigen::Vector2d(0, 0));
  EXPECT_EQ(bounds.max(), Eigen::Vector2d(10, 8));
  EXPECT_TRUE(BoundsOf({}).isEmpty());
}

TEST(Geometry2d, HolesAreOutside) {
  const Polygon polygon = WithCourtyard();
  EXPECT_TRUE(Contains(polygon, {1, 1}));
  EXPECT_TRUE(Contains(polygon, {1, 3}));  // level with corners
  EXPECT_FALSE(Contains(polygon, {4, 4}));
  EXPECT_FALSE(Contains(polygon, {11, 4}));
  EXPECT_FALSE(Contains(polygon, {-1, 3}));
  EXPECT_FALSE(Contains(Polygon{}, {0, 0}));
  EXPECT_FALSE(Contains(Ring{}, {0, 0}));
  EXPECT_TRUE(Contains(polygon.rings[1], {4, 4}));
}

TEST(Geometry2d, RingsOneAfterTheOtherArePolygons) {
  const Ring outer = {{0, 0}, {9, 0}, {9, 9}, {0, 9}}, hole = {{1, 1}, {1, 2}, {2, 2}, {2, 1}};
  const Ring other = {{20, 0}, {21, 0}, {21, 1}};
  const std::vector<Polygon> polygons = PolygonsOf({outer, hole, hole, other});
  ASSERT_EQ(polygons.size(), 2u);
  EXPECT_EQ(polygons[0].rings.size(), 3u);
  EXPECT_EQ(polygons[1].rings.size(), 1u);
  EXPECT_TRUE(PolygonsOf({}).empty());
}

TEST(Geometry2d, DistanceToASegment) {
  const Segment2d s{{0, 0}, {10, 0}};
  EXPECT_EQ(Distance(s, {5, 3}), 3);
  EXPECT_EQ(Distance(s, {13, 4}), 5);
  EXPECT_EQ(SquaredDistance(s, {-3, -4}), 25);
  EXPECT_EQ(Distance(s, {7, 0}), 0);
  EXPECT_EQ(Distance(Segment2d{{1, 1}, {1, 1}}, {4, 5}), 5);
  EXPECT_TRUE(std::isnan(Distance(s, {std::numeric_limits<double>::quiet_NaN(), 0})));
}

TEST(Geometry2d, DistanceOfSegments) {
  const Segment2d s{{0, 0}, {10, 0}};
  EXPECT_DOUBLE_EQ(SquaredDistance(s, Segment2d{{5, -1}, {5, 1}}), 0);    // cross
  EXPECT_DOUBLE_EQ(SquaredDistance(s, Segment2d{{10, 0}, {20, 5}}), 0);   // touch at an end
  EXPECT_DOUBLE_EQ(SquaredDistance(s, Segment2d{{0, 3}, {10, 3}}), 9);    // parallel
  EXPECT_DOUBLE_EQ(SquaredDistance(s, Segment2d{{13, 4}, {20, 4}}), 25);  // ends
  EXPECT_DOUBLE_EQ(SquaredDistance(s, Segment2d{{12, 0}, {15, 0}}), 4);   // on one line
  EXPECT_DOUBLE_EQ(SquaredDistance(s, Segment2d{{4, 2}, {4, 2}}), 4);     // a point
  EXPECT_DOUBLE_EQ(SquaredDistance(Segment2d{{1, 1}, {1, 1}}, Segment2d{{4, 5}, {4, 5}}), 25);
}

TEST(Geometry2d, DistanceOfSegmentsAgreesWithThatOfTheirPoints) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> at(-10, 10);
  const auto point = [&] { return Eigen::Vector2d(at(random), at(random)); };
  for (int k = 0; k < 200; ++k) {
    const Segment2d s{point(), point()};
    const Segment2d t{point(), point()};
    double least = 1e9;
    for (int i = 0; i <= 1000; ++i) {
      least = std::min(least, SquaredDistance(t, s.a + i / 1000.0 * (s.b - s.a)));
    }
    EXPECT_LE(SquaredDistance(s, t), least + 1e-9);
    EXPECT_NEAR(std::sqrt(SquaredDistance(s, t)), std::sqrt(least), 0.015);
  }
}

TEST(Geometry2d, DistanceToAPolygonIsZeroInside) {
  const Polygon polygon = WithCourtyard();
  EXPECT_EQ(Distance(polygon, {1, 1}), 0);
  EXPECT_EQ(Distance(polygon, {13, 12}), 5);
  EXPECT_EQ(Distance(polygon, {4.5, 4.25}), 0.75);
  EXPECT_EQ(Distance(Polygon{}, {0, 0}), std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace stucco
