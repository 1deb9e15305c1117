// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "plan/model/cells.h"
#include "survey/geometry2d.h"
#include "tests/plan/made_site.h"

namespace stucco::plan {
namespace {

Polygon WithCourtyard() {
  return {{{{0, 0}, {31.1, 3}, {28, 25}, {-4, 22}}, Reversed(Rectangle(8, 8, 20, 16))}};
}

bool Has(const std::vector<Cell>& cells, const Cell& cell) {
  return std::ranges::binary_search(cells, cell);
}

TEST(Cells, InsideAreThoseWhoseCentreIs) {
  const Polygon polygon = WithCourtyard();
  const std::vector<Cell> cells = CellsInside(polygon, 1.3);
  EXPECT_TRUE(std::ranges::is_sorted(cells));
  for (int32_t row = -20; row < 40; ++row) {
    for (int32_t column = -20; column < 40; ++column) {
      const Cell cell{row, column};
      EXPECT_EQ(Has(cells, cell), Contains(polygon, CenterOf(cell, 1.3)));
    }
  }
}

TEST(Cells, NearAreThoseWithinReachOfABorder) {
  const Polygon polygon = WithCourtyard();
  const std::vector<Cell> cells = CellsNear(polygon, 1.3, 5);
  for (int32_t row = -20; row < 40; ++row) {
    for (int32_t column = -20; column < 40; ++column) {
      double nearest = 1e9;
      for (const Ring& ring : polygon.rings) {
        for (size_t i = 0; i < ring.size(); ++i) {
          const Segment2d edge{ring[i], ring[(i + 1) % ring.size()]};
          nearest = std::min(nearest, Distance(edge, CenterOf({row, column}, 1.3)));
        }
      }
      EXPECT_EQ(Has(cells, {row, column}), nearest <= 5);
    }
  }
}

TEST(Cells, PolygonsWithoutAreaHaveNone) {
  EXPECT_TRUE(CellsInside({}, 1).empty());
  EXPECT_TRUE(CellsInside({{{}}}, 1).empty());
  EXPECT_TRUE(CellsInside({{{{0, 0}, {10, 0}}}}, 1).empty());
  EXPECT_TRUE(CellsNear({}, 1, 5).empty());
}

TEST(MainAxis, IsThatOfTheLongerSide) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> angles(0, std::numbers::pi);
  for (int i = 0; i < 100; ++i) {
    const double angle = angles(random);
    const Eigen::Vector2d u(std::cos(angle), std::sin(angle));
    const Eigen::Vector2d v(-u.y(), u.x());
    // A dent does not matter.
    const Ring ring{-20 * u, 20 * u, 20 * u + 10 * v, 5 * v, -20 * u + 10 * v};
    EXPECT_NEAR(std::abs(MainAxis({{ring}}).dot(u)), 1, 1e-9);
    EXPECT_GE(MainAxis({{ring}}).x(), -1e-12);
  }
}

TEST(MainAxis, OfNothingIsEast) {
  EXPECT_EQ(MainAxis({}), Eigen::Vector2d::UnitX());
  EXPECT_EQ(MainAxis({{{{3, 3}}}}), Eigen::Vector2d::UnitX());
  EXPECT_EQ(MainAxis({{{{3, 3}, {3, 3}}}}), Eigen::Vector2d::UnitX());
}

}  // namespace
}  // namespace stucco::plan
