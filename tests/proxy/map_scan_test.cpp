// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>

#include "proxy/abstract.h"
#include "proxy/cloud/normals.h"
#include "proxy/solids/closed_check.h"
#include "tests/proxy/map_scene.h"
#include "tests/proxy/scene.h"

namespace stucco {
namespace {

using test::Captured;
using test::MapEntry;
using test::Rectangle;

// What a scan from above shows: no walls, no photos, no normals.
Captured Scanned(const std::vector<test::House>& houses, double spacing) {
  test::CaptureOptions options{.spacing = spacing, .noise = 0.02};
  options.hide = {"wall", "gable", "south", "north", "east", "west"};
  Captured captured = test::Capture(houses, {test::GroundSquare(25)}, options);
  captured.photos.clear();
  captured.cloud.views.clear();
  captured.cloud.normals.clear();
  return captured;
}

struct FromScan {
  Proxy proxy;
  ProxyFindings findings;
};

FromScan MakeFromScan(const Captured& captured, const std::vector<MapEntry>& map) {
  FromScan made;
  Georef georef = test::MapGeoref();
  georef.source = "file";
  ProxyInput input = test::InputOf(captured, georef);
  input.plan = test::PlanOf(map);
  made.proxy = AbstractCloud(input, {}, 2, made.findings);
  return made;
}

TEST(MapScan, ARoofAloneBecomesAClosedHouseOnItsFootprint) {
  const Captured captured = Scanned({test::GableHouse()}, 0.3);
  const FromScan made = MakeFromScan(captured, {{"B0001", {Rectangle(-6, -4, 6, 4)}, 3}});
  const Building* house = test::Find(made.proxy, "B0001");
  ASSERT_NE(house, nullptr);
  EXPECT_EQ(house->detail, "full");
  EXPECT_EQ(FindOpening(house->facets), std::nullopt);
  ASSERT_EQ(house->facets.size(), 7u);
  EXPECT_NEAR(test::VolumeOf(*house), 744, 10);
  for (const Facet& facet : house->facets) {
    if (facet.facet_class == FacetClass::kWall) {
      EXPECT_EQ(facet.seen, 0);
      EXPECT_EQ(facet.inferred, 1);
      EXPECT_EQ(facet.source, "footprint");
      EXPECT_EQ(std::abs(facet.normal.z()), 0);
    } else if (facet.facet_class == FacetClass::kRoof) {
      EXPECT_GT(facet.seen, 0.8);
    }
  }
}

TEST(MapScan, UpIsTheCoordinateSystems) {
  // A single lean-to: its slope is no reason to tilt the world.
  test::House shed;
  shed.polygons = {{"roof", {{-6, -4, 4}, {6, -4, 4}, {6, 4, 4.4}, {-6, 4, 4.4}}}};
  const FromScan made =
      MakeFromScan(Scanned({shed}, 0.25), {{"B0001", {Rectangle(-6, -4, 6, 4)}, 3}});
  EXPECT_EQ(made.proxy.up, Eigen::Vector3d::UnitZ());
}

TEST(MapScan, AMapOfAnotherPlaceIsRefused) {
  const Captured captured = Scanned({test::GableHouse()}, 0.3);
  const std::vector<MapEntry> map = {{"B0001", {Rectangle(-6, -4, 6, 4)}, 3}};
  const FromScan made = MakeFromScan(captured, test::Displaced(map, 0, {10, 10}));
  EXPECT_EQ(test::Find(made.proxy, "B0001"), nullptr);
  EXPECT_TRUE(std::ranges::any_of(made.findings.of_map, [](const ProxyFindings::OfMap& finding) {
    return finding.warns && finding.text.find("map gives no shape") != std::string::npos;
  }));
}

bool Says(const FromScan& made, const std::string& text) {
  return std::ranges::any_of(made.findings.of_map, [&](const ProxyFindings::OfMap& finding) {
    return finding.text.find(text) != std::string::npos;
  });
}

TEST(MapScan, WithoutItsGroundNobodyKnowsHowHighRoofsAre) {
  test::CaptureOptions options{.spacing = 0.3, .noise = 0.02};
  options.hide = {"wall"};
  Captured captured = test::Capture(
      {test::FlatHouse(Rectangle(-10, -5, 0, 5), 6), test::FlatHouse(Rectangle(8, -5, 18, 5), 9)},
      {}, options);
  captured.photos.clear();
  captured.cloud.views.clear();
  captured.cloud.normals.clear();
  const FromScan made = MakeFromScan(
      captured, {{"B0001", {Rectangle(-10, -5, 0, 5)}}, {"B0002", {Rectangle(8, -5, 18, 5)}}});
  EXPECT_TRUE(Says(made, "nothing beside the buildings"));
}

// A gate: two parts on the ground, one from 5 m between them.
TEST(MapScan, WhatTheMapHasOverAPassageBeginsAboveTheGroundAndIsNamed) {
  const FromScan made = MakeFromScan(Scanned({test::FlatHouse(Rectangle(-10, -5, 10, 5), 9)}, 0.25),
                                     {{"B0001", {Rectangle(-10, -5, -4, 5)}, 9},
                                      {"B0001", {Rectangle(4, -5, 10, 5)}, 9},
                                      {"B0001", {Rectangle(-4, -5, 4, 5)}, 9, 5}});
  const Building* gate = test::Find(made.proxy, "B0001");
  ASSERT_NE(gate, nullptr);
  EXPECT_NEAR(test::VolumeOf(*gate), 20 * 10 * 9 - 8 * 10 * 5, 60);
  EXPECT_TRUE(Says(made, "begin above the ground"));
  EXPECT_FALSE(Says(made, "lacks"));
}

// The same where the map draws the upper storeys as one part over all of it.
TEST(MapScan, AStoreyThatReachesOverAPassageLeavesItOpen) {
  const FromScan made = MakeFromScan(Scanned({test::FlatHouse(Rectangle(-10, -5, 10, 5), 9)}, 0.25),
                                     {{"B0001", {Rectangle(-10, -5, -4, 5)}, 5},
                                      {"B0001", {Rectangle(4, -5, 10, 5)}, 5},
                                      {"B0001", {Rectangle(-10, -5, 10, 5)}, 9, 5}});
  const Building* gate = test::Find(made.proxy, "B0001");
  ASSERT_NE(gate, nullptr);
  EXPECT_NEAR(test::VolumeOf(*gate), 20 * 10 * 9 - 8 * 10 * 5, 60);
  EXPECT_TRUE(Says(made, "begin above the ground"));
}

TEST(MapScan, NormalsWithoutPhotosPointUp) {
  const Captured captured = Scanned({test::GableHouse()}, 0.3);
  Samples samples = ThinCloud(StreamOf(captured.cloud), {}, 100000, 0);
  const GridIndex index(samples.positions, 0.9);
  SmoothNormals(samples, index, 0.9, 1);
  const auto up = std::ranges::count_if(samples.normals, [](const auto& n) { return n.z() > 0.5; });
  EXPECT_GT(static_cast<double>(up), 0.98 * static_cast<double>(samples.size()));
}

}  // namespace
}  // namespace stucco
