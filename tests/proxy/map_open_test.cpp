// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Maps that draw more simply than what stands: corners and courtyards left out.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/proxy/map_scene.h"
#include "tests/proxy/scene.h"

namespace stucco {
namespace {

using test::AreaOf;
using test::ClosedIn;
using test::FlatHouse;
using test::kDenseCapture;
using test::MadeModel;
using test::MakeModel;
using test::OfClass;
using test::Rectangle;
using test::VolumeOf;

TEST(MapOpenGround, ACornerThatTheMapLeavesOutIsNotBuilt) {
  // An L of 14 x 12 m whose corner of 7 x 6 m is a garden; the map has a rectangle.
  const auto captured =
      test::Capture({test::LShapedHouse(14, 12, 7)}, {test::GroundSquare(25)}, kDenseCapture);
  const MadeModel made = MakeModel(captured, {{"B0001", {Rectangle(-7, -6, 7, 6)}, 7}});
  const Building& house = ClosedIn(made, "B0001");
  EXPECT_EQ(house.detail, "full");
  EXPECT_NEAR(VolumeOf(house), (14 * 12 - 7 * 6) * 7, 12);
  const auto walls = OfClass(house, FacetClass::kWall);
  ASSERT_EQ(walls.size(), 6u);
  int unknown_to_the_map = 0;
  for (const Facet* wall : walls) {
    EXPECT_GT(wall->seen, 0.8) << wall->id;
    unknown_to_the_map += wall->planned_facades.empty() ? 1 : 0;
  }
  EXPECT_EQ(unknown_to_the_map, 2);
}

TEST(MapOpenGround, ACourtyardThatTheMapLeavesOutIsNotBuilt) {
  test::House block = FlatHouse(Rectangle(-11, -11, 11, 11), 5);
  block.polygons.pop_back();
  for (auto& polygon : FlatHouse(test::Court(-6, -6, 6, 6), 5).polygons) {
    if (polygon.name == "wall") block.polygons.push_back(polygon);
  }
  for (const Ring& ring : {Rectangle(-11, -11, 11, -6), Rectangle(-11, 6, 11, 11),
                           Rectangle(-11, -6, -6, 6), Rectangle(6, -6, 11, 6)}) {
    block.polygons.push_back(FlatHouse(ring, 5).polygons.back());
  }
  const auto captured = test::Capture({block}, {test::GroundSquare(25)}, kDenseCapture);
  const MadeModel made = MakeModel(captured, {{"B0001", {Rectangle(-11, -11, 11, 11)}, 5}});
  const Building& house = ClosedIn(made, "B0001");
  EXPECT_NEAR(VolumeOf(house), (22 * 22 - 12 * 12) * 5, 20);
  EXPECT_EQ(OfClass(house, FacetClass::kWall).size(), 8u);
}

TEST(MapOpenGround, AnOutlineThatIsALittleTooLargeKeepsItsRoof) {
  // A strip of lawn along the house lies inside of its outline, and a roof that nobody saw.
  test::CaptureOptions options = kDenseCapture;
  options.hide = {"roof"};
  const auto captured =
      test::Capture({test::BoxHouse(10, 8, 6)}, {test::GroundSquare(25)}, options);
  const MadeModel made = MakeModel(captured, {{"B0001", {Rectangle(-5, -4, 5.8, 4)}, 6}});
  EXPECT_NEAR(AreaOf(ClosedIn(made, "B0001"), FacetClass::kRoof), 80, 1);
}

}  // namespace
}  // namespace stucco
