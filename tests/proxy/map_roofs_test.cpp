// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Roofs of buildings of a map where parts of them are hardly seen.
#include <gtest/gtest.h>

#include "tests/proxy/map_scene.h"
#include "tests/proxy/scene.h"

namespace stucco {
namespace {

using test::Captured;
using test::ClosedIn;
using test::FlatHouse;
using test::MadeModel;
using test::MakeModel;
using test::MapEntry;
using test::OfClass;
using test::Rectangle;
using test::TopOf;

TEST(MapRoofs, ARidgeIsOneWhereItsFarSideIsSeenOnlyAtTheEaves) {
  test::House house = test::GableHouse(12, 10, 6, 9.5);
  // Of the northern roof nothing is seen above 1.5 m from its eaves.
  house.polygons.back() = {"eaves", {{6, 5, 6}, {-6, 5, 6}, {-6, 3.5, 7.05}, {6, 3.5, 7.05}}};
  house.polygons.push_back({"upper", {{6, 3.5, 7.05}, {-6, 3.5, 7.05}, {-6, 0, 9.5}, {6, 0, 9.5}}});
  test::CaptureOptions options{.spacing = 0.2, .noise = 0.02};
  options.hide = {"upper"};
  const auto captured = test::Capture({house}, {test::GroundSquare(25)}, options);
  const MadeModel made = MakeModel(captured, {{"B0001", {Rectangle(-6, -5, 6, 5)}, 9.5}});
  const Building& building = ClosedIn(made, "B0001");
  EXPECT_EQ(building.facets.size(), 7u);
  for (const Facet* roof : OfClass(building, FacetClass::kRoof)) {
    EXPECT_NEAR(TopOf(*roof), 9.5, 0.1);
  }
}

// A level roof of 10 x 8 m at 5.6 m whose northern half nobody saw but for a point here and there,
// `every` so many metres, at the height of its parapet, 6 m.
Captured RoofWithStrays(double every) {
  test::House house = FlatHouse(Rectangle(-5, -4, 5, 4), 6);
  house.polygons.back() = {
      "roof", {{-4.5, -3.5, 5.6}, {4.5, -3.5, 5.6}, {4.5, 0.3, 5.6}, {-4.5, 0.3, 5.6}}};
  for (const Ring& strip : {Rectangle(-5, -4, 5, -3.5), Rectangle(-5, 3.5, 5, 4),
                            Rectangle(-5, -3.5, -4.5, 3.5), Rectangle(4.5, -3.5, 5, 3.5)}) {
    std::vector<Eigen::Vector3d> ring;
    for (const Eigen::Vector2d& p : strip) ring.emplace_back(p.x(), p.y(), 6);
    house.polygons.push_back({"parapet", ring});
  }
  Captured captured =
      test::Capture({house}, {test::GroundSquare(8)}, {.spacing = 0.035, .noise = 0.02});
  for (double x = -3.5; x < 3.5; x += every) {
    for (double y = 1; y < 3; y += every) {
      captured.cloud.positions.emplace_back(x, y, 6);
      captured.cloud.normals.push_back(Eigen::Vector3f::UnitZ());
      captured.cloud.colors.push_back({128, 128, 128});
      captured.cloud.views.push_back({1, 2});
    }
  }
  return captured;
}

TEST(MapRoofs, AParapetMakesNoRoofOfStrays) {
  const std::vector<MapEntry> map = {{"B0001", {Rectangle(-5, -4, 5, 4)}, 6}};
  const MadeModel made = MakeModel(RoofWithStrays(0.13), map);
  const auto roofs = OfClass(ClosedIn(made, "B0001"), FacetClass::kRoof);
  ASSERT_EQ(roofs.size(), 1u);
  EXPECT_NEAR(TopOf(*roofs[0]), 5.6, 0.02);
}

TEST(MapRoofs, WhatIsAsDenseAsTheRoofIsAPlatform) {
  const std::vector<MapEntry> map = {{"B0001", {Rectangle(-5, -4, 5, 4)}, 6}};
  const MadeModel made = MakeModel(RoofWithStrays(0.035), map);
  EXPECT_GE(OfClass(ClosedIn(made, "B0001"), FacetClass::kRoof).size(), 2u);
}

// Of a tower the uppermost walls were not seen, and of its roof a few square metres.
TEST(MapRoofs, APieceOfRoofAboveTheWallsSaysHowHighATowerIs) {
  test::House tower = FlatHouse(Rectangle(-7, -7, 7, 7), 12);
  tower.polygons.back() = {"roof", {{-6, 1, 18}, {-3, 1, 18}, {-3, 5, 18}, {-6, 5, 18}}};
  const auto captured = test::Capture({tower}, {test::GroundSquare(25)}, test::kDenseCapture);
  const MadeModel made = MakeModel(captured, {{"B0001", {Rectangle(-7, -7, 7, 7)}, 9}});
  const Building& building = ClosedIn(made, "B0001");
  EXPECT_EQ(building.facets.size(), 6u);
  EXPECT_NEAR(TopOf(*OfClass(building, FacetClass::kRoof)[0]), 18, 0.1);
}

}  // namespace
}  // namespace stucco
