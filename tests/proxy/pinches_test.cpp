// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Footprints that touch themselves in a point.
#include "proxy/map/pinches.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "proxy/map/extrude_cells.h"
#include "proxy/map/move_edges.h"
#include "tests/proxy/map_scene.h"
#include "tests/proxy/scene.h"

namespace stucco {
namespace {

using test::Court;
using test::FlatHouse;
using test::Rectangle;

double AreaOfAll(const std::vector<Polygon>& parts) {
  double area = 0;
  for (const Polygon& part : parts) area += Area(part);
  return area;
}

// The farthest that any corner went.
double FarthestMove(const std::vector<Polygon>& before, const std::vector<Polygon>& after) {
  double farthest = 0;
  for (size_t p = 0; p < before.size(); ++p) {
    for (size_t r = 0; r < before[p].rings.size(); ++r) {
      for (size_t i = 0; i < before[p].rings[r].size(); ++i) {
        farthest = std::max(farthest, (before[p].rings[r][i] - after[p].rings[r][i]).norm());
      }
    }
  }
  return farthest;
}

TEST(OpenPinches, DrawsBackOneOfTwoCornersThatTouch) {
  const std::vector<Polygon> before = {{{Rectangle(-10, -8, 0, 0)}}, {{Rectangle(0, 0, 10, 8)}}};
  std::vector<Polygon> parts = before;
  OpenPinches(parts);
  EXPECT_NE(parts[0].rings, before[0].rings);
  EXPECT_EQ(parts[1].rings, before[1].rings);
  EXPECT_NEAR(FarthestMove(before, parts), 0.03, 1e-9);
  EXPECT_LT(AreaOfAll(parts), AreaOfAll(before));
}

TEST(OpenPinches, ACornerInTheMiddleOfAnotherPartsWall) {
  const std::vector<Polygon> before = {{{Rectangle(-10, -8, 0, 8)}},
                                       {{{{0, 0}, {5, -5}, {10, 0}, {5, 5}}}}};
  std::vector<Polygon> parts = before;
  OpenPinches(parts);
  EXPECT_EQ(parts[0].rings, before[0].rings);
  EXPECT_NEAR(parts[1].rings[0][0].x(), 0.03, 1e-9);
}

TEST(OpenPinches, ACourtyardThatReachesTheStreet) {
  std::vector<Polygon> parts = {{{Rectangle(-10, -8, 10, 8), {{10, 8}, {5, -2}, {-2, 3}}}}};
  ASSERT_FALSE(IsSimple(parts[0]));
  OpenPinches(parts);
  EXPECT_TRUE(IsSimple(parts[0]));
}

TEST(OpenPinches, ARingThatTouchesItself) {
  std::vector<Polygon> parts = {{{{{0, 0}, {10, -5}, {10, 5}, {0, 0}, {-10, 5}, {-10, -5}}}}};
  ASSERT_FALSE(IsSimple(parts[0]));
  OpenPinches(parts);
  EXPECT_TRUE(IsSimple(parts[0]));
  EXPECT_NEAR(AreaOfAll(parts), 100, 0.5);
}

TEST(OpenPinches, LeavesPartsThatShareWalls) {
  // Three parts around one corner, a gap beside the fourth; one wall ends in another's middle.
  const std::vector<Polygon> before = {{{Rectangle(-10, -8, 0, 0)}},
                                       {{Rectangle(0, 0, 10, 8)}},
                                       {{Rectangle(0, -8, 10, 0)}},
                                       {{Rectangle(10, -3, 15, 4)}}};
  std::vector<Polygon> parts = before;
  OpenPinches(parts);
  EXPECT_EQ(FarthestMove(before, parts), 0);
}

// Every building closes at full detail, whatever point its parts meet in.
TEST(Pinches, HousesOfTwoPartsThatMeetInACornerClose) {
  test::House both = FlatHouse(Rectangle(-12, -9, 0, 0), 6);
  for (auto& polygon : FlatHouse(Rectangle(0, 0, 12, 9), 6).polygons) {
    both.polygons.push_back(std::move(polygon));
  }
  const auto captured = test::Capture({both}, {test::GroundSquare(25)}, test::kDenseCapture);
  const auto made = test::MakeModel(
      captured, {{"B0001", {Rectangle(-12, -9, 0, 0)}, 6}, {"B0001", {Rectangle(0, 0, 12, 9)}, 6}});
  const Building& building = test::ClosedIn(made, "B0001");
  EXPECT_EQ(building.detail, "full");
  EXPECT_EQ(building.facets.size(), 12u);
  EXPECT_NEAR(test::VolumeOf(building), 2 * 12 * 9 * 6, 15);
}

TEST(Pinches, AHouseWhoseCourtyardReachesTheStreetCloses) {
  const Ring outline = Rectangle(-12, -9, 12, 9), court = {{12, 9}, {5, -2}, {-2, 3}};
  test::House house = FlatHouse(outline, 6);
  std::erase_if(house.polygons, [](const auto& polygon) { return polygon.name == "roof"; });
  for (auto& polygon : FlatHouse(court, 6).polygons) {
    if (polygon.name != "roof") house.polygons.push_back(std::move(polygon));
  }
  // The roof around the court, cut at its corners.
  const auto add = [&](const Ring& piece) {
    test::TruePolygon& roof =
        house.polygons.emplace_back(test::TruePolygon{.name = "roof", .ring = {}});
    for (const Eigen::Vector2d& corner : piece) roof.ring.emplace_back(corner.x(), corner.y(), 6);
  };
  add({{-12, -9}, {12, -9}, {5, -2}, {-2, 3}});
  add({{12, -9}, {12, 9}, {5, -2}});
  add({{12, 9}, {-12, 9}, {-2, 3}});
  add({{-12, 9}, {-12, -9}, {-2, 3}});
  const auto captured = test::Capture({house}, {test::GroundSquare(25)}, test::kDenseCapture);
  const auto made = test::MakeModel(captured, {{"B0001", {outline, court}, 6}});
  const Building& building = test::ClosedIn(made, "B0001");
  EXPECT_EQ(building.detail, "full");
  const double area = Area(Polygon{{outline, court}});
  EXPECT_NEAR(test::VolumeOf(building), area * 6, 15);
}

// Four cells of a footprint, two of which the ground shows through: with one roof over the others
// nothing but roofing one of the open ones makes a solid.
TEST(JoinAtCorners, RoofsOverOneOfTwoYardsThatMeetInACorner) {
  Eigen::AlignedBox2d box(Eigen::Vector2d(-5, -5), Eigen::Vector2d(5, 5));
  const std::vector<CutLine> lines = {{.point = {0, 1}, .direction = {1, 0}},
                                      {.point = {0, 0}, .direction = {0, 1}}};
  const Arrangement arrangement = Arrange(box, lines);
  ASSERT_EQ(arrangement.faces.size(), 4u);
  std::vector<int> labels;
  for (size_t f = 0; f < 4; ++f) {
    const Eigen::Vector2d middle = InnerPoint(arrangement, f);
    labels.push_back((middle.x() > 0) == (middle.y() > 1) ? 0 : -1);
  }
  const std::vector<RoofPlane> roofs = {{.height = 6}};
  std::vector<int> outside = labels;
  JoinAtCorners(arrangement, roofs, {false, false, false, false}, outside);
  EXPECT_EQ(outside, labels);
  JoinAtCorners(arrangement, roofs, {true, true, true, true}, labels);
  for (size_t f = 0; f < 4; ++f) {
    const Eigen::Vector2d middle = InnerPoint(arrangement, f);
    const bool open = middle.x() > 0 && middle.y() < 1;  // the larger one stays so
    EXPECT_EQ(labels[f], open ? -1 : 0) << f;
  }
}

}  // namespace
}  // namespace stucco
