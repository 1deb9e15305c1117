// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
// What stands and is not on the map.
#include <gtest/gtest.h>

#include <algorithm>

#include "proxy/solids/closed_check.h"
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
using test::Rectangle;
using test::VolumeOf;

size_t WallsOf(const Building& building) {
  return static_cast<size_t>(
      std::ranges::count(building.facets, FacetClass::kWall, &Facet::facet_class));
}

TEST(NewBuildings, AWingThatTheMapLacksBecomesAPartOfItsHouse) {
  // An L of 14 x 12 m; the map has its southern bar, 14 x 6 m.
  const auto captured =
      test::Capture({test::LShapedHouse(14, 12, 7)}, {test::GroundSquare(25)}, kDenseCapture);
  const MadeModel made = MakeModel(captured, {{"B0001", {Rectangle(-7, -6, 7, 0)}, 7}});
  EXPECT_EQ(test::Find(made.proxy, "C0001"), nullptr);
  const Building& house = ClosedIn(made, "B0001");
  EXPECT_EQ(FindOpening(house.facets), std::nullopt);
  EXPECT_EQ(house.source, "map");
  EXPECT_EQ(house.detail, "full");
  EXPECT_NEAR(VolumeOf(house), (14 * 6 + 7 * 6) * 7, 15);
  // No wall between them, and one roof; the wall that goes on along both ends where the map does.
  EXPECT_EQ(house.facets.size(), 9u);
  for (const Facet& facet : house.facets) {
    const bool is_floor = facet.facet_class == FacetClass::kGround;
    EXPECT_NEAR(facet.party, is_floor ? 1 : 0, 0.05) << facet.id;
  }
  // Only walls of the map have its facades.
  const auto named = std::ranges::count_if(
      house.facets, [](const Facet& facet) { return !facet.planned_facades.empty(); });
  EXPECT_GE(named, 3);
  EXPECT_LT(static_cast<size_t>(named), WallsOf(house));
}

TEST(NewBuildings, ALowerWingLeavesTheWallAboveItsRoof) {
  test::House wing = FlatHouse(Rectangle(0, 4, 6, 9), 4);
  const auto captured = test::Capture({FlatHouse(Rectangle(-7, -4, 7, 4), 8), wing},
                                      {test::GroundSquare(25)}, kDenseCapture);
  const MadeModel made = MakeModel(captured, {{"B0001", {Rectangle(-7, -4, 7, 4)}, 8}});
  EXPECT_EQ(test::Find(made.proxy, "C0001"), nullptr);
  const Building& house = ClosedIn(made, "B0001");
  EXPECT_EQ(FindOpening(house.facets), std::nullopt);
  EXPECT_NEAR(VolumeOf(house), 14 * 8 * 8 + 6 * 5 * 4, 15);
  EXPECT_NEAR(AreaOf(house, FacetClass::kWall), 2 * (14 + 8) * 8 + (6 + 2 * 5) * 4 - 6 * 4, 8);
}

TEST(NewBuildings, BalconiesAreNoRoofs) {
  // The same wing with a balcony, 1 m deep, along most of its western wall.
  test::House house = test::LShapedHouse(14, 12, 7);
  house.polygons.push_back({"balcony", {{-8, 0.5, 4}, {-7, 0.5, 4}, {-7, 5.5, 4}, {-8, 5.5, 4}}});
  const auto captured = test::Capture({house}, {test::GroundSquare(25)}, kDenseCapture);
  const MadeModel made = MakeModel(captured, {{"B0001", {Rectangle(-7, -6, 7, 0)}, 7}});
  EXPECT_EQ(test::Find(made.proxy, "C0001"), nullptr);
  EXPECT_NEAR(VolumeOf(ClosedIn(made, "B0001")), (14 * 6 + 7 * 6) * 7, 15);
}

TEST(NewBuildings, ALargerNeighbourIsAHouseOfItsOwn) {
  const auto captured =
      test::Capture({FlatHouse(Rectangle(-9, -4, -2, 4), 6), FlatHouse(Rectangle(-2, -4, 9, 4), 9)},
                    {test::GroundSquare(25)}, kDenseCapture);
  const MadeModel made = MakeModel(captured, {{"B0001", {Rectangle(-9, -4, -2, 4)}, 6}});
  EXPECT_NEAR(VolumeOf(ClosedIn(made, "B0001")), 7 * 8 * 6, 10);
  const Building* other = test::Find(made.proxy, "C0001");
  ASSERT_NE(other, nullptr);
  EXPECT_TRUE(other->watertight);
  EXPECT_EQ(other->source, "cloud");
  EXPECT_NEAR(VolumeOf(*other), 11 * 8 * 9, 15);
  // Each hides the other's wall.
  const auto hidden = std::ranges::count_if(other->facets, [](const Facet& facet) {
    return facet.facet_class == FacetClass::kWall && facet.party > 0.6;
  });
  EXPECT_EQ(hidden, 1);
}

TEST(NewBuildings, AHouseBesideTheMapHasItsOwnRoof) {
  test::House gable = test::GableHouse(12, 8, 6, 9.5);
  for (auto& polygon : gable.polygons) {
    for (auto& p : polygon.ring) p.x() += 13;
  }
  const auto captured = test::Capture({FlatHouse(Rectangle(-15, -4, -4, 4), 6), gable},
                                      {test::GroundSquare(25)}, kDenseCapture);
  const MadeModel made = MakeModel(captured, {{"B0001", {Rectangle(-15, -4, -4, 4)}, 6}});
  const Building* house = test::Find(made.proxy, "C0001");
  ASSERT_NE(house, nullptr);
  EXPECT_TRUE(house->watertight);
  EXPECT_NEAR(VolumeOf(*house), 744, 15);
  EXPECT_EQ(house->facets.size(), 7u);
  EXPECT_EQ(test::Find(made.proxy, "C0002"), nullptr);
}

TEST(NewBuildings, TreesAndEavesAreNone) {
  test::House house = FlatHouse(Rectangle(-6, -4, 6, 4), 6);
  // Eaves of 0.9 m all around.
  house.polygons.back().ring = {{-6.9, -4.9, 6}, {6.9, -4.9, 6}, {6.9, 4.9, 6}, {-6.9, 4.9, 6}};
  auto captured = test::Capture({house}, {test::GroundSquare(25)}, kDenseCapture);
  test::AddTree({12, 2, 5}, 3, 12000, 4, captured);
  test::AddTree({-12, -3, 4}, 2.5, 9000, 5, captured);
  const MadeModel made = MakeModel(captured, {{"B0001", {Rectangle(-6, -4, 6, 4)}, 6}});
  EXPECT_NEAR(AreaOf(ClosedIn(made, "B0001"), FacetClass::kRoof), 96, 3);
  EXPECT_EQ(test::Find(made.proxy, "C0001"), nullptr);
}

// A crown that is dense above and has only stray leaves below is seen as well as any roof.
TEST(NewBuildings, ARoofWithoutWallsIsACrown) {
  test::House crown = test::GableHouse(6, 5, 7, 9);
  for (auto& polygon : crown.polygons) {
    for (auto& p : polygon.ring) p.x() += 14;
  }
  const auto is_new = [&](bool with_walls) {
    test::House shown = crown;
    if (!with_walls) {
      std::erase_if(shown.polygons, [](const auto& polygon) {
        return std::ranges::any_of(polygon.ring, [](const auto& p) { return p.z() < 1; });
      });
    }
    const auto captured = test::Capture({FlatHouse(Rectangle(-6, -4, 6, 4), 6), shown},
                                        {test::GroundSquare(25)}, kDenseCapture);
    const MadeModel made = MakeModel(captured, {{"B0001", {Rectangle(-6, -4, 6, 4)}, 6}});
    return test::Find(made.proxy, "C0001") != nullptr;
  };
  EXPECT_TRUE(is_new(true));
  EXPECT_FALSE(is_new(false));
}

// Its roof lies on walls of which only a strip below the eaves is seen.
TEST(NewBuildings, AHouseWhoseWallsAreHardlySeenIsNamed) {
  test::House tower = FlatHouse(Rectangle(14, -4, 24, 4), 16);
  for (auto& polygon : tower.polygons) {
    for (auto& p : polygon.ring) p.z() = std::max(p.z(), 13.2);
  }
  const auto captured = test::Capture({FlatHouse(Rectangle(-6, -4, 6, 4), 6), tower},
                                      {test::GroundSquare(25)}, kDenseCapture);
  const MadeModel made = MakeModel(captured, {{"B0001", {Rectangle(-6, -4, 6, 4)}, 6}});
  EXPECT_EQ(test::Find(made.proxy, "C0001"), nullptr);
  EXPECT_TRUE(std::ranges::any_of(made.findings.of_map, [](const ProxyFindings::OfMap& finding) {
    return finding.warns && finding.text.starts_with("a house seems to stand on no footprint");
  }));
}

// Between its neighbours it shows the upper halves of two short walls, less than a fifth of all its
// walls: the long ones are nobody's to see.
TEST(NewBuildings, WallsThatNeighboursHideAreNotAskedFor) {
  test::House gap = FlatHouse(Rectangle(-3, -8, 3, 8), 10);
  const size_t walls = gap.polygons.size() - 1;
  for (size_t w = 0; w < walls; ++w) {
    test::TruePolygon below = gap.polygons[w];
    below.name = "unseen";
    for (auto& p : below.ring) p.z() = std::min(p.z(), 5.0);
    for (auto& p : gap.polygons[w].ring) p.z() = std::max(p.z(), 5.0);
    gap.polygons.push_back(below);
  }
  test::CaptureOptions options = kDenseCapture;
  options.hide = {"unseen"};
  const auto captured = test::Capture(
      {FlatHouse(Rectangle(-15, -8, -3, 8), 10), gap, FlatHouse(Rectangle(3, -8, 15, 8), 10)},
      {test::GroundSquare(30)}, options);
  const MadeModel made = MakeModel(captured, {{"B0001", {Rectangle(-15, -8, -3, 8)}, 10},
                                              {"B0002", {Rectangle(3, -8, 15, 8)}, 10}});
  double volume = 0;
  for (const Building& building : made.proxy.buildings) {
    if (building.watertight) volume += VolumeOf(building);
  }
  EXPECT_NEAR(volume, 30 * 16 * 10, 60);
}

}  // namespace
}  // namespace stucco
