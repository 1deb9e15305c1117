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

TEST(NewBuildings, AWingThatTheMapLacksIsClosedBesideItsHouse) {
  // An L of 14 x 12 m; the map has its southern bar, 14 x 6 m.
  const auto captured =
      test::Capture({test::LShapedHouse(14, 12, 7)}, {test::GroundSquare(25)}, kDenseCapture);
  const MadeModel made = MakeModel(captured, {{"B0001", {Rectangle(-7, -6, 7, 0)}, 7}});
  EXPECT_NEAR(VolumeOf(ClosedIn(made, "B0001")), 14 * 6 * 7, 12);
  const Building* wing = test::Find(made.proxy, "C0001");
  ASSERT_NE(wing, nullptr);
  EXPECT_TRUE(wing->watertight);
  EXPECT_EQ(FindOpening(wing->facets), std::nullopt);
  EXPECT_EQ(wing->source, "cloud");
  EXPECT_EQ(wing->detail, "full");
  EXPECT_NEAR(VolumeOf(*wing), 7 * 6 * 7, 10);
  EXPECT_EQ(wing->facets.size(), 6u);
  // The house and its wing hide each other's wall.
  const auto hidden =
      std::ranges::count_if(wing->facets, [](const Facet& facet) { return facet.party > 0.95; });
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

}  // namespace
}  // namespace stucco
