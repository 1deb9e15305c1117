// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Walls of a map that others stand against.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/proxy/map_scene.h"
#include "tests/proxy/scene.h"

namespace stucco {
namespace {

using test::ClosedIn;
using test::FlatHouse;
using test::OfClass;
using test::Rectangle;

// Two houses side by side, the eastern one half as deep; the map has the wall between them, and
// what goes on in it, 30 cm too far to the west.
TEST(MapWalls, AWallThatANeighbourPartlyCoversStaysStraight) {
  const auto captured =
      test::Capture({FlatHouse(Rectangle(-10, -8, 0, 8), 6), FlatHouse(Rectangle(0, -8, 10, 0), 6)},
                    {test::GroundSquare(25)}, test::kDenseCapture);
  const Ring deep = {{-10, -8}, {-0.3, -8}, {-0.3, 0}, {-0.3, 8}, {-10, 8}};
  const auto made =
      test::MakeModel(captured, {{"B0001", {deep}, 6}, {"B0002", {Rectangle(-0.3, -8, 10, 0)}, 6}});
  const Building& house = ClosedIn(made, "B0001");
  EXPECT_NEAR(test::VolumeOf(house), 10 * 16 * 6, 8);
  const auto walls = OfClass(house, FacetClass::kWall);
  EXPECT_EQ(walls.size(), 4u);
  for (const Facet* wall : walls) {
    const double nearest_axis = wall->normal.cwiseAbs().maxCoeff();
    EXPECT_NEAR(nearest_axis, 1, 1e-4) << wall->id;
  }
  EXPECT_NEAR(test::VolumeOf(ClosedIn(made, "B0002")), 10 * 8 * 6, 8);
}

}  // namespace
}  // namespace stucco
