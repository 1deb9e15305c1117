// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/map/map_solids.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "proxy/abstract.h"
#include "proxy/solids/closed_check.h"
#include "tests/proxy/map_scene.h"
#include "tests/proxy/scene.h"

namespace stucco {
namespace {

using test::Captured;
using test::ClosedIn;
using test::Court;
using test::Displaced;
using test::FlatHouse;
using test::MadeModel;
using test::MakeModel;
using test::MapEntry;
using test::OfClass;
using test::Rectangle;
using test::TopOf;
using test::VolumeOf;

constexpr test::CaptureOptions kCapture{.spacing = 0.2, .noise = 0.02};

bool Says(const std::vector<std::string>& lines, const std::string& text) {
  return std::ranges::any_of(
      lines, [&](const std::string& line) { return line.find(text) != std::string::npos; });
}

bool SaysOfMap(const ProxyFindings& findings, const std::string& text, bool warns) {
  return std::ranges::any_of(findings.of_map, [&](const ProxyFindings::OfMap& finding) {
    return finding.text.find(text) != std::string::npos && finding.warns == warns;
  });
}

// Every facade of the building's ring is on exactly one wall, and that wall lies on it.
void ExpectFacades(const Building& building, size_t count) {
  std::multiset<std::string> ids;
  for (const Facet* wall : OfClass(building, FacetClass::kWall)) {
    ids.insert(wall->planned_facades.begin(), wall->planned_facades.end());
  }
  EXPECT_EQ(ids.size(), count);
  EXPECT_EQ(std::set<std::string>(ids.begin(), ids.end()).size(), count);
}

TEST(MapSolids, ClosesAGableHouse) {
  const auto captured = test::Capture({test::GableHouse()}, {test::GroundSquare(25)}, kCapture);
  const MadeModel made = MakeModel(captured, {{"B0001", {Rectangle(-6, -4, 6, 4)}, 9.5}});
  const Building& house = ClosedIn(made, "B0001");
  EXPECT_EQ(OfClass(house, FacetClass::kWall).size(), 4u);
  EXPECT_EQ(OfClass(house, FacetClass::kRoof).size(), 2u);
  EXPECT_EQ(house.facets.size(), 7u);
  ExpectFacades(house, 4);
  // 12 x 8 x 6 and half of 12 x 8 x 3.5.
  EXPECT_NEAR(VolumeOf(house), 744, 10);
  for (const Facet* roof : OfClass(house, FacetClass::kRoof)) EXPECT_NEAR(TopOf(*roof), 9.5, 0.08);
  for (const Facet* wall : OfClass(house, FacetClass::kWall)) EXPECT_GT(wall->seen, 0.8);
  EXPECT_TRUE(Says(made.findings.notes, "B0001: closed, full"));
}

TEST(MapSolids, ClosesAHipRoof) {
  const auto captured =
      test::Capture({test::HipHouse(14, 8, 5)}, {test::GroundSquare(25)}, kCapture);
  const MadeModel made = MakeModel(captured, {{"B0001", {Rectangle(-7, -4, 7, 4)}, 9}});
  const Building& house = ClosedIn(made, "B0001");
  EXPECT_EQ(OfClass(house, FacetClass::kRoof).size(), 4u);
  EXPECT_EQ(OfClass(house, FacetClass::kWall).size(), 4u);
  ExpectFacades(house, 4);
  // Below the hip roof: 14 x 8 x 5; the roof: a ridge of 6 m, 4 m above the eaves.
  EXPECT_NEAR(VolumeOf(house), 560 + 4.0 / 6 * 8 * (2 * 14 + 6), 12);
}

TEST(MapSolids, RoofsThatMeetHaveNoWallsBetweenThem) {
  const test::House house = test::HipLHouse(4);
  for (const uint64_t seed : {1, 2, 3}) {
    const auto captured = test::Capture({house}, {test::GroundSquare(25)},
                                        {.spacing = 0.2, .noise = 0.03, .seed = seed});
    const MadeModel made = MakeModel(captured, {{"B0001", {test::HipLOutline()}, 7}});
    const Building& building = ClosedIn(made, "B0001");
    EXPECT_EQ(OfClass(building, FacetClass::kWall).size(), 6u) << seed;
    EXPECT_EQ(OfClass(building, FacetClass::kRoof).size(), 6u) << seed;
    ExpectFacades(building, 6);
  }
}

TEST(MapSolids, StepsBetweenTwoHeights) {
  // An L whose wings have flat roofs at 8 and 5 m.
  test::House tall = FlatHouse(Rectangle(-8, -5, 0, 5), 8);
  test::House low = FlatHouse(Rectangle(0, -5, 8, 0), 5);
  low.polygons.erase(low.polygons.begin() + 3);  // inside of the tall wing
  const auto captured = test::Capture({tall, low}, {test::GroundSquare(25)}, kCapture);
  const Ring ring = {{-8, -5}, {8, -5}, {8, 0}, {0, 0}, {0, 5}, {-8, 5}};
  const MadeModel made = MakeModel(captured, {{"B0001", {ring}, 8}});
  const Building& house = ClosedIn(made, "B0001");
  const auto roofs = OfClass(house, FacetClass::kRoof);
  ASSERT_EQ(roofs.size(), 2u);
  EXPECT_NEAR(TopOf(*roofs[0]), 8, 0.05);
  EXPECT_NEAR(roofs[0]->area, 80, 1.5);
  EXPECT_NEAR(TopOf(*roofs[1]), 5, 0.05);
  EXPECT_NEAR(roofs[1]->area, 40, 1.5);
  // Six walls of the map; the step goes on in the wall that it is in line with.
  EXPECT_EQ(OfClass(house, FacetClass::kWall).size(), 6u);
  ExpectFacades(house, 6);
  EXPECT_NEAR(VolumeOf(house), 840, 10);
}

TEST(MapSolids, KeepsCourtyards) {
  test::House block = FlatHouse(Rectangle(-11, -11, 11, 11), 5);
  block.polygons.pop_back();
  for (auto& polygon : FlatHouse(Court(-5, -5, 5, 5), 5).polygons) {
    if (polygon.name == "wall") block.polygons.push_back(polygon);
  }
  // The roof in four pieces around the court.
  for (const Ring& ring : {Rectangle(-11, -11, 11, -5), Rectangle(-11, 5, 11, 11),
                           Rectangle(-11, -5, -5, 5), Rectangle(5, -5, 11, 5)}) {
    block.polygons.push_back(FlatHouse(ring, 5).polygons.back());
  }
  const auto captured = test::Capture({block}, {test::GroundSquare(25)}, kCapture);
  const MadeModel made =
      MakeModel(captured, {{"B0001", {Rectangle(-11, -11, 11, 11), Court(-5, -5, 5, 5)}, 5}});
  const Building& house = ClosedIn(made, "B0001");
  EXPECT_EQ(OfClass(house, FacetClass::kWall).size(), 8u);
  ASSERT_EQ(OfClass(house, FacetClass::kRoof).size(), 1u);
  EXPECT_EQ(OfClass(house, FacetClass::kRoof)[0]->holes.size(), 1u);
  ExpectFacades(house, 8);
  EXPECT_NEAR(VolumeOf(house), (484 - 100) * 5, 25);
}

TEST(MapSolids, WithoutRoofPointsEndsWhereItsWallsEnd) {
  test::CaptureOptions options = kCapture;
  options.hide = {"roof"};
  const auto captured =
      test::Capture({test::BoxHouse(10, 8, 6)}, {test::GroundSquare(25)}, options);
  const MadeModel made = MakeModel(captured, {{"B0001", {Rectangle(-5, -4, 5, 4)}, 9}});
  const Building& house = ClosedIn(made, "B0001");
  EXPECT_EQ(house.facets.size(), 6u);
  EXPECT_NEAR(VolumeOf(house), 80 * 6, 80 * 0.6);  // the walls' top, within their last 10 %
  EXPECT_EQ(OfClass(house, FacetClass::kRoof)[0]->seen, 0);
  EXPECT_TRUE(Says(made.findings.notes, "B0001: closed, LoD1.2"));
}

TEST(MapSolids, WhatLiesInsideOfATowerIsNotItsRoof) {
  test::CaptureOptions options = kCapture;
  options.hide = {"roof"};
  test::House floors = FlatHouse(Rectangle(-6, -6, 6, 0), 15);  // of loggias
  floors.polygons = {floors.polygons.back()};
  floors.polygons.back().name = "floors";
  test::House tower = FlatHouse(Rectangle(-7, -7, 7, 7), 40);
  tower.polygons.back().name = "roof";
  const auto captured = test::Capture({tower, floors}, {test::GroundSquare(25)}, options);
  const MadeModel made = MakeModel(captured, {{"B0001", {Rectangle(-7, -7, 7, 7)}, 9}});
  const Building& house = ClosedIn(made, "B0001");
  EXPECT_EQ(house.facets.size(), 6u);
  EXPECT_NEAR(TopOf(*OfClass(house, FacetClass::kRoof)[0]), 40, 0.4);
  EXPECT_TRUE(Says(made.findings.notes, "B0001: closed, LoD1.2"));
}

// A street of boxes of different sizes.
struct StreetOfFive {
  std::vector<test::House> houses;
  std::vector<MapEntry> map;
};

StreetOfFive MakeStreet() {
  StreetOfFive street;
  const std::vector<Ring> rings = {Rectangle(-18, -12, -8, -4), Rectangle(-2, -13, 5, -4),
                                   Rectangle(9, -11, 19, -5), Rectangle(-16, 4, -9, 15),
                                   Rectangle(-1, 5, 12, 12)};
  for (size_t i = 0; i < rings.size(); ++i) {
    const double height = 5 + static_cast<double>(i);
    street.houses.push_back(FlatHouse(rings[i], height));
    street.map.push_back({"B000" + std::to_string(i + 1), {rings[i]}, height});
  }
  return street;
}

TEST(MapSolids, FindsADisplacedMap) {
  const StreetOfFive street = MakeStreet();
  const auto captured = test::Capture(street.houses, {test::GroundSquare(30)}, kCapture);
  const MadeModel made = MakeModel(captured, Displaced(street.map, 0.3, {1.4, -1.4}));
  const std::vector<double> areas = {80, 63, 60, 77, 91};
  for (size_t i = 0; i < 5; ++i) {
    const Building& house = ClosedIn(made, street.map[i].id);
    EXPECT_EQ(house.facets.size(), 6u);
    EXPECT_NEAR(test::AreaOf(house, FacetClass::kRoof), areas[i], 0.02 * areas[i]);
    // Each corner is where the house stands, not where the map has it.
    for (const Facet* roof : OfClass(house, FacetClass::kRoof)) {
      for (const auto& p : roof->outer) {
        double nearest = 1e9;
        for (const auto& corner : street.map[i].rings[0]) {
          nearest = std::min(nearest, (corner - p.head<2>()).norm());
        }
        EXPECT_LT(nearest, 0.12);
      }
    }
    ExpectFacades(house, 4);
  }
}

TEST(MapSolids, TellsEavesFromShifts) {
  StreetOfFive street = MakeStreet();
  // Every building digitised by itself along its eaves, and of each one wall that no photo shows.
  const std::vector<Eigen::Vector2d> shifts = {
      {0.4, 0.1}, {-0.3, 0.4}, {0.1, -0.4}, {-0.4, -0.2}, {0.3, 0.3}};
  std::vector<MapEntry> map;
  for (size_t i = 0; i < street.map.size(); ++i) {
    street.houses[i].polygons[i % 4].name = "hidden";
    const Ring& ring = street.map[i].rings[0];
    const Eigen::Vector2d low = ring[0] + shifts[i], high = ring[2] + shifts[i];
    map.push_back({street.map[i].id,
                   {Rectangle(low.x() - 0.5, low.y() - 0.5, high.x() + 0.5, high.y() + 0.5)},
                   street.map[i].top});
  }
  test::CaptureOptions options = kCapture;
  options.hide = {"hidden"};
  const auto captured = test::Capture(street.houses, {test::GroundSquare(30)}, options);
  const MadeModel made = MakeModel(captured, map);
  for (const MapEntry& entry : street.map) {
    const Building& house = ClosedIn(made, entry.id);
    // The three walls in sight, and the fourth where they and the other houses say.
    for (const Facet* wall : OfClass(house, FacetClass::kWall)) {
      double nearest = 1e9;
      for (const auto& corner : entry.rings[0]) {
        nearest = std::min(nearest, std::abs(wall->normal.head<2>().dot(corner) - wall->offset));
      }
      EXPECT_LT(nearest, wall->seen > 0 ? 0.05 : 0.2) << wall->id;
    }
  }
}

TEST(MapSolids, PanesAreNoWallWhereTheOtherWallsSaySo) {
  // One wall shows more of its windows, 0.19 m behind it, than of itself.
  StreetOfFive street = MakeStreet();
  const Ring& ring = street.map[0].rings[0];
  const Eigen::Vector2d a = ring[2], b = ring[3];
  const Eigen::Vector2d inwards = -0.19 * OutwardsOf({a, b});
  const auto upright = [](const Eigen::Vector2d& p, const Eigen::Vector2d& q, double low,
                          double high) {
    return std::vector<Eigen::Vector3d>{
        {p.x(), p.y(), low}, {q.x(), q.y(), low}, {q.x(), q.y(), high}, {p.x(), p.y(), high}};
  };
  test::House& house = street.houses[0];
  house.polygons[2] = {"plaster", upright(a, b, 0, 3.0)};
  house.polygons.push_back({"panes", upright(a + inwards, b + inwards, 3.0, 6)});
  const auto captured = test::Capture(street.houses, {test::GroundSquare(30)}, kCapture);
  const MadeModel made = MakeModel(captured, street.map);
  for (const Facet* wall : OfClass(ClosedIn(made, street.map[0].id), FacetClass::kWall)) {
    const Eigen::Vector2d outwards = wall->normal.head<2>();
    if (outwards.dot(OutwardsOf({a, b})) < 0.99) continue;
    EXPECT_NEAR(wall->offset, outwards.dot(a), 0.04);
  }
}

TEST(MapSolids, SaysThatAMapLiesElsewhere) {
  const StreetOfFive street = MakeStreet();
  auto map = street.map;
  for (MapEntry& entry : map) {
    for (Eigen::Vector2d& corner : entry.rings[0]) corner += Eigen::Vector2d(1.2, -0.5);
  }
  const auto captured = test::Capture(street.houses, {test::GroundSquare(30)}, kCapture);
  EXPECT_TRUE(SaysOfMap(MakeModel(captured, map).findings, "the map lies 1.3 m beside", false));
  EXPECT_TRUE(MakeModel(captured, street.map).findings.of_map.empty());
}

TEST(MapSolids, RefusesAMapOfAnotherTown) {
  const StreetOfFive street = MakeStreet();
  const auto captured = test::Capture(street.houses, {test::GroundSquare(30)}, kCapture);
  const std::vector<MapEntry> elsewhere = {{"B0001", {Rectangle(-24, -2, -12, 2)}, 6},
                                           {"B0002", {Rectangle(-6, -3, 8, 3)}, 6},
                                           {"B0003", {Rectangle(14, -26, 20, 20)}, 6},
                                           {"B0004", {Rectangle(-8, 16, 10, 28)}, 6},
                                           {"B0005", {Rectangle(-28, -26, -20, -14)}, 6}};
  const MadeModel with = MakeModel(captured, elsewhere);
  EXPECT_TRUE(SaysOfMap(with.findings, "the plan's map gives no shape", true));
  // The same as without any map.
  ProxyFindings findings;
  const Proxy without = AbstractCloud(test::InputOf(captured, test::MapGeoref()), {}, 2, findings);
  ASSERT_EQ(with.proxy.buildings.size(), without.buildings.size());
  for (size_t b = 0; b < without.buildings.size(); ++b) {
    EXPECT_EQ(with.proxy.buildings[b].id, without.buildings[b].id);
    EXPECT_EQ(with.proxy.buildings[b].facets.size(), without.buildings[b].facets.size());
  }
}

TEST(MapSolids, NamesWhatIsGoneAndWhatIsNew) {
  StreetOfFive street = MakeStreet();
  street.houses.erase(street.houses.begin() + 1);  // B0002 is no more
  const Ring fresh = Rectangle(16, 4, 25, 13);
  street.houses.push_back(FlatHouse(fresh, 6));  // no map has it
  const auto captured = test::Capture(street.houses, {test::GroundSquare(30)}, kCapture);
  const MadeModel made = MakeModel(captured, street.map);
  EXPECT_EQ(test::Find(made.proxy, "B0002"), nullptr);
  EXPECT_TRUE(SaysOfMap(made.findings, "B0002: not built, or demolished", true));
  for (const char* id : {"B0001", "B0003", "B0004", "B0005"}) ClosedIn(made, id);
  EXPECT_TRUE(SaysOfMap(made.findings, "C0001: stands on no footprint of the map, 81 m2", false));
  const Building* found = test::Find(made.proxy, "C0001");
  ASSERT_NE(found, nullptr);
  EXPECT_TRUE(found->watertight);
  EXPECT_NEAR(VolumeOf(*found), 81 * 6, 15);
}

// The hill above the lowest ground around a footprint is as smooth as a roof, and no house.
TEST(MapSolids, NamesWhatIsGoneOnASlope) {
  constexpr double kSlope = 0.25;
  const auto on_hill = [](test::House house) {
    for (auto& polygon : house.polygons) {
      for (auto& p : polygon.ring) p.z() = p.z() > 0 ? p.z() + 3 : kSlope * p.x();
    }
    return house;
  };
  const std::vector<Ring> standing = {Rectangle(-9, -20, 3, -12), Rectangle(-6, 10, 6, 20),
                                      Rectangle(12, -16, 21, -6)};
  std::vector<test::House> houses;
  std::vector<MapEntry> map;
  for (const Ring& ring : standing) {
    houses.push_back(on_hill(FlatHouse(ring, 6)));
    map.push_back({"B000" + std::to_string(map.size() + 1), {ring}, 9});
  }
  map.push_back({"B0004", {Rectangle(-8, -5, 8, 4)}, 9});
  auto hill = test::GroundSquare(30);
  for (auto& p : hill.ring) p.z() = kSlope * p.x();
  const MadeModel made = MakeModel(test::Capture(houses, {hill}, kCapture), map);
  for (const char* id : {"B0001", "B0002", "B0003"}) ClosedIn(made, id);
  EXPECT_EQ(test::Find(made.proxy, "B0004"), nullptr);
  EXPECT_TRUE(SaysOfMap(made.findings, "B0004: not built, or demolished", true));
}

TEST(MapSolids, ExtrudesWhatNobodySaw) {
  const StreetOfFive street = MakeStreet();
  auto map = street.map;
  map.push_back({"B0009", {Rectangle(60, 60, 70, 70)}, 7});
  const auto captured = test::Capture(street.houses, {test::GroundSquare(30)}, kCapture);
  const MadeModel made = MakeModel(captured, map);
  const Building& house = ClosedIn(made, "B0009");
  EXPECT_NEAR(VolumeOf(house), 700, 20);
  for (const Facet& facet : house.facets) EXPECT_EQ(facet.seen, 0);
  EXPECT_TRUE(SaysOfMap(made.findings, "B0009: the cloud shows too little", true));
}

TEST(MapSolids, TreesAreNoPartOfABuilding) {
  auto captured = test::Capture({test::BoxHouse(12, 9, 6)}, {test::GroundSquare(25)}, kCapture);
  test::AddTree({9, 2, 5}, 2.8, 4000, 3, captured);  // beside the eastern wall, and over it
  test::AddTree({-3, 1, 9}, 2, 2500, 4, captured);   // over the roof
  const MadeModel made = MakeModel(captured, {{"B0001", {Rectangle(-6, -4.5, 6, 4.5)}, 6}});
  const Building& house = ClosedIn(made, "B0001");
  EXPECT_EQ(house.facets.size(), 6u);
  EXPECT_NEAR(VolumeOf(house), 12 * 9 * 6, 10);
  EXPECT_EQ(made.proxy.buildings.size(), 2u);  // the house and the ground: no tree
}

TEST(MapSolids, LeavesAboveBareGroundAreNoRoof) {
  // Two patches of leaves as smooth as a roof, and a crown around them.
  const test::House crown{
      {{"low", {{14.5, -2.5, 4}, {17, -2.5, 5}, {17, 1.5, 5}, {14.5, 1.5, 4}}},
       {"high", {{17.3, -2, 6}, {19.6, -2, 6}, {19.6, 1.5, 7}, {17.3, 1.5, 7}}}}};
  auto captured =
      test::Capture({test::BoxHouse(12, 9, 6), crown}, {test::GroundSquare(25)}, kCapture);
  test::AddTree({17, -0.5, 5.5}, 2.5, 2500, 3, captured);
  const MadeModel made = MakeModel(captured, {{"B0001", {Rectangle(-6, -4.5, 6, 4.5)}, 6},
                                              {"B0002", {Rectangle(14, -3, 20, 2)}, 6}});
  ClosedIn(made, "B0001");
  EXPECT_EQ(test::Find(made.proxy, "B0002"), nullptr);
  EXPECT_TRUE(SaysOfMap(made.findings, "B0002: not built, or demolished", true));
}

TEST(MapSolids, ACrownThatHoldsAnOutlineIsNoHouse) {
  // Leaves that stand upright along all edges of what the map has, and lie flat here and there.
  auto captured = test::Capture({test::BoxHouse(12, 9, 6)}, {test::GroundSquare(25)}, kCapture);
  for (const auto& [x, y] :
       {std::pair{15.0, -2.0}, {17.0, -2.0}, {19.0, -2.0}, {15.0, 1.0}, {17.0, 1.0}, {19.0, 1.0}}) {
    test::AddTree({x, y, 3.5}, 1.8, 2500, 3, captured);
  }
  const MadeModel made = MakeModel(captured, {{"B0001", {Rectangle(-6, -4.5, 6, 4.5)}, 6},
                                              {"B0002", {Rectangle(14, -3, 20, 2)}, 6}});
  ClosedIn(made, "B0001");
  EXPECT_EQ(test::Find(made.proxy, "B0002"), nullptr);
}

TEST(MapSolids, ARoofOnPostsStands) {
  auto canopy = FlatHouse(Rectangle(12, -4, 20, 4), 4.5);
  canopy.polygons = {canopy.polygons.back()};
  const auto captured =
      test::Capture({test::BoxHouse(10, 9, 6), canopy}, {test::GroundSquare(25)}, kCapture);
  const MadeModel made = MakeModel(captured, {{"B0001", {Rectangle(-5, -4.5, 5, 4.5)}, 6},
                                              {"B0002", {Rectangle(12, -4, 20, 4)}, 4.5}});
  EXPECT_NEAR(VolumeOf(ClosedIn(made, "B0002")), 64 * 4.5, 10);
}

TEST(MapSolids, AParapetIsNoRoof) {
  test::House house = FlatHouse(Rectangle(-6, -4, 6, 4), 6);
  house.polygons.back().ring = {
      {-5.5, -3.5, 5.6}, {5.5, -3.5, 5.6}, {5.5, 3.5, 5.6}, {-5.5, 3.5, 5.6}};
  house.polygons.push_back({"rim", {{-6, -4, 6}, {6, -4, 6}, {5.5, -3.5, 5.6}, {-5.5, -3.5, 5.6}}});
  house.polygons.push_back({"rim", {{6, -4, 6}, {6, 4, 6}, {5.5, 3.5, 5.6}, {5.5, -3.5, 5.6}}});
  const auto captured =
      test::Capture({house}, {test::GroundSquare(25)}, {.spacing = 0.1, .noise = 0.02});
  const MadeModel made = MakeModel(captured, {{"B0001", {Rectangle(-6, -4, 6, 4)}, 6}});
  EXPECT_EQ(ClosedIn(made, "B0001").facets.size(), 6u);
}

TEST(MapSolids, ARoofLiesOnItselfNotBetweenItAndItsRim) {
  constexpr double kRoof = 5.75;
  test::House house = FlatHouse(Rectangle(-6, -4, 6, 4), 6);
  house.polygons.back().ring = {
      {-5.2, -3.2, kRoof}, {5.2, -3.2, kRoof}, {5.2, 3.2, kRoof}, {-5.2, 3.2, kRoof}};
  for (const Ring& strip : {Rectangle(-6, -4, 6, -3.2), Rectangle(-6, 3.2, 6, 4),
                            Rectangle(-6, -3.2, -5.2, 3.2), Rectangle(5.2, -3.2, 6, 3.2)}) {
    std::vector<Eigen::Vector3d> ring;
    for (const Eigen::Vector2d& p : strip) ring.emplace_back(p.x(), p.y(), 6);
    house.polygons.push_back({"rim", ring});
  }
  const auto captured =
      test::Capture({house}, {test::GroundSquare(25)}, {.spacing = 0.1, .noise = 0.02});
  const MadeModel made = MakeModel(captured, {{"B0001", {Rectangle(-6, -4, 6, 4)}, 6}});
  const auto roofs = OfClass(ClosedIn(made, "B0001"), FacetClass::kRoof);
  ASSERT_EQ(roofs.size(), 1u);
  EXPECT_NEAR(TopOf(*roofs[0]), kRoof, 0.02);
}

TEST(MapSolids, NeighboursKeepTouching) {
  // Two houses of different height wall to wall; the map is 0.4 m off.
  test::House tall = FlatHouse(Rectangle(-8, -4, 0, 4), 8);
  test::House low = FlatHouse(Rectangle(0, -4, 9, 4), 5);
  low.polygons.erase(low.polygons.begin() + 3);
  const auto captured = test::Capture({tall, low}, {test::GroundSquare(25)}, kCapture);
  const MadeModel made = MakeModel(captured, Displaced({{"B0001", {Rectangle(-8, -4, 0, 4)}, 8},
                                                        {"B0002", {Rectangle(0, -4, 9, 4)}, 5}},
                                                       0, {0.4, 0.2}));
  const Building& left = ClosedIn(made, "B0001");
  const Building& right = ClosedIn(made, "B0002");
  EXPECT_NEAR(VolumeOf(left), 8 * 8 * 8, 12);
  EXPECT_NEAR(VolumeOf(right), 9 * 8 * 5, 10);
  const auto faces = [](const Building& building, const Eigen::Vector3d& normal) {
    for (const Facet& facet : building.facets) {
      if (facet.normal.dot(normal) > 0.99) return facet.offset;
    }
    return 1e9;
  };
  EXPECT_NEAR(faces(left, Eigen::Vector3d::UnitX()), -faces(right, -Eigen::Vector3d::UnitX()),
              1e-9);
  // The low house hides as much of the tall one's wall as it is high, and all of its own.
  for (const Facet* wall : OfClass(left, FacetClass::kWall)) {
    EXPECT_NEAR(wall->party, wall->normal.x() > 0.99 ? 5.0 / 8 : 0, 0.02);
  }
  for (const Facet* wall : OfClass(right, FacetClass::kWall)) {
    EXPECT_NEAR(wall->party, wall->normal.x() < -0.99 ? 1 : 0, 0.02);
  }
}

TEST(MapSolids, DetailsDoNotDependOnTheSizeOfTheSurvey) {
  std::vector<test::House> houses;
  std::vector<MapEntry> map;
  for (const double x : {-14, 14}) {
    for (const double y : {-10, 10}) {
      const Ring ring = Rectangle(x - 6, y - 4, x + 6, y + 4);
      houses.push_back(FlatHouse(ring, 6));
      map.push_back({"B000" + std::to_string(houses.size()), {ring}, 8.5});
      test::House lift = FlatHouse(Rectangle(x - 1, y - 1, x + 1, y + 1), 8.5);
      for (auto& polygon : lift.polygons) {
        for (auto& corner : polygon.ring) corner.z() = std::max(corner.z(), 6.0);
      }
      houses.push_back(lift);
    }
  }
  // The survey may have as many samples as one of its houses needs.
  const auto captured = test::Capture(houses, {test::GroundSquare(40)}, {.noise = 0.02});
  const MadeModel made = MakeModel(captured, map, {.max_points = 50000});
  EXPECT_TRUE(Says(made.findings.warnings, "the level of detail is"));
  for (const MapEntry& entry : map) {
    const Building& house = ClosedIn(made, entry.id);
    EXPECT_EQ(OfClass(house, FacetClass::kRoof).size(), 2u);
    EXPECT_NEAR(VolumeOf(house), 12 * 8 * 6 + 2 * 2 * 2.5, 4);
  }
}

TEST(MapSolids, UsesNoMapWhenToldSo) {
  const auto captured = test::Capture({test::GableHouse()}, {test::GroundSquare(25)}, kCapture);
  const MadeModel made =
      MakeModel(captured, {{"B0001", {Rectangle(-6, -4, 6, 4)}, 9.5}}, {.use_map = false});
  EXPECT_EQ(test::Find(made.proxy, "B0001"), nullptr);
  EXPECT_NE(test::Find(made.proxy, "C0001"), nullptr);
}

}  // namespace
}  // namespace stucco
