// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Parts of buildings that begin above the ground.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "proxy/map/extrude_cells.h"
#include "proxy/map/outlines.h"
#include "tests/proxy/map_scene.h"
#include "tests/proxy/scene.h"

namespace stucco {
namespace {

using test::FlatHouse;
using test::Rectangle;

// Two houses of 10 x 8 m, 4 m apart, and a wing of 3 m height over the passage between them.
test::House GateHouse() {
  test::House gate = FlatHouse(Rectangle(-12, -4, -2, 4), 6);
  for (const auto& polygon : FlatHouse(Rectangle(2, -4, 12, 4), 6).polygons) {
    gate.polygons.push_back(polygon);
  }
  gate.polygons.push_back({"roof", {{-2, -4, 6}, {2, -4, 6}, {2, 4, 6}, {-2, 4, 6}}});
  gate.polygons.push_back({"wall", {{-2, -4, 3}, {2, -4, 3}, {2, -4, 6}, {-2, -4, 6}}});
  gate.polygons.push_back({"wall", {{2, 4, 3}, {-2, 4, 3}, {-2, 4, 6}, {2, 4, 6}}});
  gate.polygons.push_back({"underside", {{-2, 4, 3}, {2, 4, 3}, {2, -4, 3}, {-2, -4, 3}}});
  return gate;
}

std::vector<test::MapEntry> GateMap() {
  return {{.id = "B0001", .rings = {Rectangle(-12, -4, -2, 4)}, .top = 6},
          {.id = "B0001", .rings = {Rectangle(2, -4, 12, 4)}, .top = 6},
          {.id = "B0001", .rings = {Rectangle(-2, -4, 2, 4)}, .top = 6, .foot = 3}};
}

TEST(HangingParts, BeginAtTheirUndersides) {
  const auto captured = test::Capture({GateHouse()}, {test::GroundSquare(25)}, test::kDenseCapture);
  const test::MadeModel made = test::MakeModel(captured, GateMap());
  const Building& gate = test::ClosedIn(made, "B0001");
  EXPECT_EQ(gate.detail, "full");
  EXPECT_NEAR(test::VolumeOf(gate), 24 * 8 * 6 - 4 * 8 * 3, 15);
  const auto undersides = test::OfClass(gate, FacetClass::kOuterFloor);
  ASSERT_EQ(undersides.size(), 1u);
  EXPECT_EQ(undersides.front()->source, "footprint");
  EXPECT_NEAR(undersides.front()->area, 4 * 8, 1);
  EXPECT_LT(undersides.front()->normal.z(), -0.99);
  EXPECT_NEAR(test::TopOf(*undersides.front()), 3, 0.1);
  // The floors of both houses, without that of the passage.
  EXPECT_NEAR(test::AreaOf(gate, FacetClass::kGround), 2 * 10 * 8, 3);
  const bool is_named = std::ranges::any_of(made.findings.of_map, [](const auto& finding) {
    return finding.text.find("from where it has their undersides") != std::string::npos;
  });
  EXPECT_TRUE(is_named);
}

// Two storeys over the passage; the map names the upper one first.
TEST(HangingParts, BeginWithTheLowestStoreyWhateverTheMapNamesFirst) {
  std::vector<test::MapEntry> map = GateMap();
  map[2] = {.id = "B0001", .rings = {Rectangle(-2, -4, 2, 4)}, .top = 9, .foot = 6};
  map.push_back({.id = "B0001", .rings = {Rectangle(-2, -4, 2, 4)}, .top = 6, .foot = 3});
  const OutlineMap outlines =
      OutlinesOf(test::PlanOf(map), test::MapGeoref(), Eigen::Vector3d::UnitZ());
  ASSERT_EQ(outlines.buildings.size(), 1u);
  ASSERT_EQ(outlines.buildings[0].hanging.size(), 1u);
  EXPECT_NEAR(outlines.buildings[0].hanging[0].underside_m, 3, 1e-9);
  ASSERT_EQ(outlines.buildings[0].raised.size(), 1u);
  EXPECT_NEAR(outlines.buildings[0].raised[0].underside_m, 6, 1e-9);
}

// What nobody knows is as high as the flight stays clear of: 50 m are no height to build by.
TEST(OutlinesOf, TakesUnknownHeightsForTwoStoreys) {
  Plan plan = test::PlanOf({{.id = "B0001", .rings = {Rectangle(-12, -4, -2, 4)}, .top = 50},
                            {.id = "B0002", .rings = {Rectangle(2, -4, 12, 4)}, .top = 12}});
  plan.safe_altitude_m = 60;
  plan.d_min_m = 10;
  const auto top_of = [&](size_t building) {
    return OutlinesOf(plan, test::MapGeoref(), Eigen::Vector3d::UnitZ())
        .buildings[building]
        .z_m.to_m;
  };
  EXPECT_EQ(top_of(0), 50);  // the map says so
  for (PlannedFacade& facade : plan.facades) facade.top_known = false;
  EXPECT_EQ(top_of(0), 6);
  EXPECT_EQ(top_of(1), 12);  // a guess by storeys
}

// Three cells of 4 x 6 m beside each other, under a level roof of 4 m or a pitched one of 9 to 12
// m.
class ExtrudedStoreys : public testing::Test {
 protected:
  ExtrudedStoreys() {
    for (const double x : {0.0, 4.0, 8.0, 12.0}) lines_.push_back({{x, 0}, {0, 1}});
    for (const double y : {0.0, 6.0}) lines_.push_back({{0, y}, {1, 0}});
    plan_ = Arrange({Eigen::Vector2d(-1, -1), Eigen::Vector2d(13, 7)}, lines_);
    storeys_.labels.assign(plan_.faces.size(), -1);
    storeys_.floors.assign(plan_.faces.size(), 0);
    storeys_.roofs = roofs_;
  }

  void Put(int column, int label, double floor) {
    for (size_t f = 0; f < plan_.faces.size(); ++f) {
      const Eigen::Vector2d p = InnerPoint(plan_, f);
      if (p.y() < 0 || p.y() > 6 || p.x() < 4 * column || p.x() > 4 * (column + 1)) continue;
      storeys_.labels[f] = label;
      storeys_.floors[f] = floor;
    }
  }

  // By the divergence theorem, with faces checked to close: the sum of area vectors is zero.
  double Volume() const {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    double volume = 0;
    for (const ExtrudedFace& face : ExtrudeCells(plan_, lines_, storeys_)) {
      Eigen::Vector3d area = Eigen::Vector3d::Zero();
      const auto add = [&](const std::vector<Eigen::Vector3d>& ring) {
        for (size_t i = 0; i < ring.size(); ++i) {
          area += ring[i].cross(ring[(i + 1) % ring.size()]) / 2;
        }
      };
      add(face.outer);
      for (const auto& hole : face.holes) add(hole);
      EXPECT_GT(area.dot(face.normal), 0);
      sum += area;
      volume += area.dot(face.normal) * face.offset / 3;
    }
    EXPECT_LT(sum.norm(), 1e-9);
    return volume;
  }

  size_t Undersides() const {
    const auto faces = ExtrudeCells(plan_, lines_, storeys_);
    return std::ranges::count(faces, ExtrudedFace::Kind::kUnderside, &ExtrudedFace::kind);
  }

 private:
  std::vector<CutLine> lines_;
  std::vector<RoofPlane> roofs_ = {{.slope = {0, 0}, .height = 4},
                                   {.slope = {0, 0.5}, .height = 9}};
  Arrangement plan_;
  Storeys storeys_;
};

TEST_F(ExtrudedStoreys, APassageBetweenTwoHouses) {
  Put(0, 1, 0);
  Put(1, 1, 5);
  Put(2, 1, 0);
  EXPECT_NEAR(Volume(), 72 * 10.5 - 24 * 5, 1e-9);
  EXPECT_EQ(Undersides(), 1u);
}

TEST_F(ExtrudedStoreys, ABalconyBesideALowerHouse) {
  Put(0, 0, 0);
  Put(1, 1, 0);
  Put(2, 1, 5);
  EXPECT_NEAR(Volume(), 24 * 4 + 24 * 10.5 + 24 * 5.5, 1e-9);
}

TEST_F(ExtrudedStoreys, WhatHangsAboveTheRoofBesideItDoesNotTouchIt) {
  Put(0, 0, 0);
  Put(1, 1, 5);
  EXPECT_NEAR(Volume(), 24 * 4 + 24 * 5.5, 1e-9);
}

TEST_F(ExtrudedStoreys, FloorsOfTwoHeights) {
  Put(0, 1, 0);
  Put(1, 1, 3);
  Put(2, 1, 5);
  EXPECT_NEAR(Volume(), 72 * 10.5 - 24 * 3 - 24 * 5, 1e-9);
  EXPECT_EQ(Undersides(), 2u);
}

}  // namespace
}  // namespace stucco
