// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Houses closed on footprints that the cloud alone shows.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "proxy/abstract.h"
#include "proxy/planes/consolidate.h"
#include "proxy/solids/closed_check.h"
#include "tests/proxy/map_scene.h"
#include "tests/proxy/scene.h"

namespace stucco {
namespace {

using test::AreaOf;
using test::Court;
using test::FlatHouse;
using test::kDenseCapture;
using test::Rectangle;
using test::VolumeOf;

test::MadeModel ModelOf(const test::Captured& captured) {
  test::MadeModel made;
  made.proxy = AbstractCloud(test::InputOf(captured, test::MapGeoref()), {}, 2, made.findings);
  EXPECT_EQ(FindProblem(made.proxy), std::nullopt);
  return made;
}

const Building& ClosedAlone(const test::MadeModel& made) {
  static const Building kNone;
  const Building* building = test::Find(made.proxy, "C0001");
  EXPECT_EQ(test::Find(made.proxy, "C0002"), nullptr);
  EXPECT_NE(building, nullptr);
  if (building == nullptr) return kNone;
  EXPECT_TRUE(building->watertight);
  EXPECT_EQ(building->detail, "full");
  EXPECT_EQ(building->source, "cloud");
  EXPECT_EQ(FindOpening(building->facets), std::nullopt);
  return *building;
}

TEST(WithoutAMap, HousesThatTouchAreOneSolid) {
  const auto captured = test::Capture(
      {FlatHouse(Rectangle(-10, -4, -2, 4), 6), FlatHouse(Rectangle(-2, -4, 10, 4), 9)},
      {test::GroundSquare(25)}, kDenseCapture);
  const auto made = ModelOf(captured);
  const Building& houses = ClosedAlone(made);
  EXPECT_NEAR(VolumeOf(houses), 8 * 8 * 6 + 12 * 8 * 9, 20);
  EXPECT_NEAR(AreaOf(houses, FacetClass::kRoof), 20 * 8, 4);
  // The higher one shows 3 m of its wall above the lower one.
  EXPECT_NEAR(AreaOf(houses, FacetClass::kWall), (8 + 2 * 8) * 6 + (8 + 2 * 12) * 9 + 8 * 3, 12);
}

// The larger house is found first; it is not the first of the line that numbers them.
TEST(WithoutAMap, HousesAreNumberedByPlace) {
  const auto captured = test::Capture(
      {FlatHouse(Rectangle(-14, -4, -6, 2), 6), FlatHouse(Rectangle(2, -6, 14, 6), 9)},
      {test::GroundSquare(25)}, kDenseCapture);
  const auto made = ModelOf(captured);
  const Building* first = test::Find(made.proxy, "C0001");
  const Building* second = test::Find(made.proxy, "C0002");
  ASSERT_NE(first, nullptr);
  ASSERT_NE(second, nullptr);
  EXPECT_NEAR(AreaOf(*first, FacetClass::kRoof), 8 * 6, 3);
  EXPECT_NEAR(AreaOf(*second, FacetClass::kRoof), 12 * 12, 4);
}

TEST(WithoutAMap, AYardStaysOpen) {
  test::House house = FlatHouse(Rectangle(-12, -12, 12, 12), 5);
  const test::House yard = FlatHouse(Court(-5, -5, 5, 5), 5);
  house.polygons.pop_back();
  for (const auto& wall : yard.polygons) {
    if (&wall != &yard.polygons.back()) house.polygons.push_back(wall);
  }
  for (const auto& [name, ring] : {std::pair{"south", Rectangle(-12, -12, 12, -5)},
                                   {"north", Rectangle(-12, 5, 12, 12)},
                                   {"west", Rectangle(-12, -5, -5, 5)},
                                   {"east", Rectangle(5, -5, 12, 5)}}) {
    test::TruePolygon& roof = house.polygons.emplace_back();
    roof.name = name;
    for (const auto& p : ring) roof.ring.emplace_back(p.x(), p.y(), 5);
  }
  const auto captured = test::Capture({house}, {test::GroundSquare(30)}, kDenseCapture);
  const auto made = ModelOf(captured);
  EXPECT_NEAR(VolumeOf(ClosedAlone(made)), (24 * 24 - 10 * 10) * 5, 60);
}

// The same house whole, and with a strip of its roof that no photo shows.
TEST(WithoutAMap, ARoofGoesOnWhereNothingIsSeen) {
  for (const bool hidden : {false, true}) {
    test::House house = FlatHouse(Rectangle(-8, -4, 8, 4), 6);
    house.polygons.pop_back();
    for (const auto& [name, from, to] :
         {std::tuple{"west roof", -8.0, -2.0}, {"strip", -2.0, 1.0}, {"east roof", 1.0, 8.0}}) {
      house.polygons.push_back({name, {{from, -4, 6}, {to, -4, 6}, {to, 4, 6}, {from, 4, 6}}});
    }
    test::CaptureOptions options = kDenseCapture;
    if (hidden) options.hide = {"strip"};
    const auto made = ModelOf(test::Capture({house}, {test::GroundSquare(25)}, options));
    const Building& closed = ClosedAlone(made);
    EXPECT_NEAR(VolumeOf(closed), 16 * 8 * 6, 12) << hidden;
    EXPECT_EQ(closed.facets.size(), 6u) << hidden;
  }
}

TEST(WithoutAMap, AnAlleyStaysOpen) {
  const auto captured = test::Capture(
      {FlatHouse(Rectangle(-11, -4, -1, 4), 5), FlatHouse(Rectangle(1, -4, 11, 4), 5)},
      {test::GroundSquare(25)}, kDenseCapture);
  const auto made = ModelOf(captured);
  double volume = 0;
  int closed = 0;
  for (const Building& building : made.proxy.buildings) {
    if (!building.watertight) continue;
    ++closed;
    volume += VolumeOf(building);
  }
  EXPECT_EQ(closed, 2);
  EXPECT_NEAR(volume, 2 * 10 * 8 * 5, 20);
}

// Crowns that lean over a wall reach above the roof and below it.
TEST(WithoutAMap, TreesAgainstAHouseAreNoPartOfIt) {
  auto captured = test::Capture({FlatHouse(Rectangle(-8, -4, 8, 4), 6)}, {test::GroundSquare(25)},
                                kDenseCapture);
  test::AddTree({9.5, 1, 5.5}, 2.5, 9000, 4, captured);
  test::AddTree({-3, -6, 5}, 2.2, 7000, 5, captured);
  const auto made = ModelOf(captured);
  const Building& house = ClosedAlone(made);
  EXPECT_NEAR(VolumeOf(house), 16 * 8 * 6, 25);
  EXPECT_NEAR(AreaOf(house, FacetClass::kRoof), 16 * 8, 5);
}

// Their fronts are a plane of 21 m2, a metre before the wall, which shows between them.
TEST(WithoutAMap, AHouseEndsBehindItsBalconies) {
  test::House house = FlatHouse(Rectangle(-9, -4, 9, 4), 9);
  for (const double z : {2.5, 5.5}) {
    for (const double x : {-7.5, -3.5, 0.5, 4.5}) {
      const double x1 = x + 2.6, y0 = -5.1, y1 = -4.05, top = z + 1;
      house.polygons.push_back({"front", {{x, y0, z}, {x1, y0, z}, {x1, y0, top}, {x, y0, top}}});
      house.polygons.push_back({"top", {{x, y0, top}, {x1, y0, top}, {x1, y1, top}, {x, y1, top}}});
    }
  }
  const auto made = ModelOf(test::Capture({house}, {test::GroundSquare(25)}, kDenseCapture));
  const Building& closed = ClosedAlone(made);
  EXPECT_NEAR(VolumeOf(closed), 18 * 8 * 9, 30);
  EXPECT_LE(closed.facets.size(), 8u);
}

// A scan from above shows roofs and ground, and no walls.
TEST(WithoutAMap, AScanFromAboveGivesSolids) {
  auto captured =
      test::Capture({test::GableHouse(12, 8, 6, 9.5)}, {test::GroundSquare(25)},
                    {.spacing = 0.3, .noise = 0.02, .hide = {"south", "north", "east", "west"}});
  captured.photos.clear();
  captured.cloud.views.clear();
  const auto made = ModelOf(captured);
  const Building& house = ClosedAlone(made);
  EXPECT_NEAR(VolumeOf(house), 744, 40);
  for (const Facet& facet : house.facets) {
    if (facet.facet_class == FacetClass::kWall) {
      EXPECT_EQ(facet.source, "extruded");
    }
  }
}

TEST(LeafScatterDeg, IsWellAboveWhatSmoothPlanesHave) {
  Samples samples;
  std::vector<std::vector<Plane>> buildings(2);
  const auto add = [&](std::vector<Plane>& building, double scatter_deg, double area) {
    Plane& plane = building.emplace_back();
    plane.area = area;
    for (int i = 0; i < 40; ++i) {
      const double turn = (i % 2 == 0 ? scatter_deg : -scatter_deg) * std::numbers::pi / 180;
      plane.points.push_back(static_cast<int>(samples.size()));
      samples.positions.emplace_back(i, i % 7, 0);
      samples.normals.emplace_back(std::sin(turn), 0, std::cos(turn));
    }
  };
  add(buildings[0], 4, 20);
  add(buildings[0], 8, 50);
  for (int i = 0; i < 9; ++i) add(buildings[1], 18, 5);  // many, and small
  EXPECT_NEAR(LeafScatterDeg(samples, buildings), 8 + 6, 0.01);
  EXPECT_GT(LeafScatterDeg(samples, {}), 90);
}

// Long beams that hang on one across, with nothing seen of the ground between them.
TEST(WithoutAMap, AFrameIsNoHouse) {
  test::House frame;
  for (const double y : {-6.0, -1.5, 3.0}) {
    const test::House beam = test::BoxHouse(16, 2.5, 6, {0, y, 0});
    frame.polygons.insert(frame.polygons.end(), beam.polygons.begin(), beam.polygons.end());
  }
  const test::House across = test::BoxHouse(2.5, 11.5, 6, {-9.25, -1.5, 0});
  frame.polygons.insert(frame.polygons.end(), across.polygons.begin(), across.polygons.end());
  const auto flat = [](const std::string& name, double x0, double y0, double x1, double y1) {
    return test::TruePolygon{name, {{x0, y0, 0}, {x1, y0, 0}, {x1, y1, 0}, {x0, y1, 0}}};
  };
  const auto made = ModelOf(
      test::Capture({frame},
                    {flat("south ground", -25, -25, 25, -8), flat("north ground", -25, 5, 25, 25),
                     flat("west ground", -25, -8, -11, 5), flat("east ground", 9, -8, 25, 5),
                     flat("below", -11, -8, 9, 5)},
                    {.spacing = 0.1, .noise = 0.02, .hide = {"below"}}));
  double roofs = 0;
  for (const Building& building : made.proxy.buildings) {
    if (building.watertight) roofs += AreaOf(building, FacetClass::kRoof);
  }
  EXPECT_LE(roofs, (3 * 16 + 11.5) * 2.5 + 8);
}

// Both sides of the roof have one area, and so have opposite walls.
TEST(WithoutAMap, FacetsAreNumberedByPlaceWhateverTheNoise) {
  std::vector<test::MadeModel> made;
  for (const uint64_t seed : {1, 2, 3}) {
    test::CaptureOptions options = kDenseCapture;
    options.seed = seed;
    made.push_back(ModelOf(test::Capture({test::GableHouse()}, {test::GroundSquare(20)}, options)));
  }
  const Building& first = ClosedAlone(made[0]);
  for (size_t m = 1; m < made.size(); ++m) {
    const Building& again = ClosedAlone(made[m]);
    ASSERT_EQ(again.facets.size(), first.facets.size());
    for (size_t f = 0; f < first.facets.size(); ++f) {
      EXPECT_EQ(again.facets[f].id, first.facets[f].id);
      EXPECT_GT(again.facets[f].normal.dot(first.facets[f].normal), 0.98) << first.facets[f].id;
    }
  }
}

}  // namespace
}  // namespace stucco
