// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Maps that draw more simply than what stands: corners and courtyards left out.
#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

#include "proxy/map/open_ground.h"
#include "tests/proxy/map_scene.h"
#include "tests/proxy/scene.h"

namespace stucco {
namespace {

constexpr Tolerances kTolerances{.spacing = 0.1};

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

// Its crown hides the ground below it, and is no house for that.
TEST(MapOpenGround, ATreeInTheGardenIsNotBuilt) {
  auto captured =
      test::Capture({test::LShapedHouse(14, 12, 7)}, {test::GroundSquare(25)}, kDenseCapture);
  constexpr double kRadius_m = 1.8;
  const Eigen::Vector2d tree(5.6, 4.6);
  test::EraseIf(
      [&](const Eigen::Vector3d& p) {
        return p.z() < 0.5 && (p.head<2>() - tree).norm() < kRadius_m;
      },
      captured);
  test::AddTree({tree.x(), tree.y(), 5}, kRadius_m, 4000, 3, captured);
  const MadeModel made = MakeModel(captured, {{"B0001", {Rectangle(-7, -6, 7, 6)}, 7}});
  const Building& house = ClosedIn(made, "B0001");
  EXPECT_NEAR(VolumeOf(house), (14 * 12 - 7 * 6) * 7, 12);
  EXPECT_EQ(OfClass(house, FacetClass::kWall).size(), 6u);
}

// Towers and narrow yards hide their ground; photos that see the walls of the corner look through
// it.
TEST(MapOpenGround, ACornerWhoseGroundNobodySawIsNotBuilt) {
  std::vector<test::TruePolygon> ground;
  for (const Ring& ring : {Rectangle(-25, -25, 25, -6), Rectangle(-25, 6, 25, 25),
                           Rectangle(-25, -6, -7, 6), Rectangle(7, -6, 25, 6)}) {
    test::TruePolygon& piece = ground.emplace_back(test::TruePolygon{.name = "ground", .ring = {}});
    for (const Eigen::Vector2d& corner : ring) piece.ring.emplace_back(corner.x(), corner.y(), 0);
  }
  const auto captured = test::Capture({test::LShapedHouse(14, 12, 7)}, ground, kDenseCapture);
  const MadeModel made = MakeModel(captured, {{"B0001", {Rectangle(-7, -6, 7, 6)}, 7}});
  const Building& house = ClosedIn(made, "B0001");
  EXPECT_EQ(house.detail, "full");
  EXPECT_NEAR(VolumeOf(house), (14 * 12 - 7 * 6) * 7, 12);
  EXPECT_EQ(OfClass(house, FacetClass::kWall).size(), 6u);
}

// The valley of a hip roof ends where the walls meet that the map leaves out, to the millimetre,
// wherever noise puts these walls.
TEST(MapOpenGround, AValleyEndsInTheCornerOfTheGarden) {
  Eigen::AlignedBox2d box;
  for (const Eigen::Vector2d& corner : test::HipLOutline()) box.extend(corner);
  const Ring map = Rectangle(box.min().x(), box.min().y(), box.max().x(), box.max().y());
  for (const uint32_t seed : {1u, 2u, 3u, 4u, 5u, 6u}) {
    test::CaptureOptions options = kDenseCapture;
    options.seed = seed;
    const auto captured = test::Capture({test::HipLHouse(5)}, {test::GroundSquare(25)}, options);
    const MadeModel made = MakeModel(captured, {{"B0001", {map}, 8}});
    const Building& house = ClosedIn(made, "B0001");
    EXPECT_EQ(house.detail, "full") << seed;
    EXPECT_EQ(OfClass(house, FacetClass::kWall).size(), 6u) << seed;
    EXPECT_EQ(OfClass(house, FacetClass::kRoof).size(), 6u) << seed;
    for (const Facet& facet : house.facets) {
      for (size_t i = 0; i < facet.outer.size(); ++i) {
        const Eigen::Vector3d& next = facet.outer[(i + 1) % facet.outer.size()];
        if (next.z() > 6) continue;  // ridges of two wings may differ in height
        EXPECT_GT((next - facet.outer[i]).norm(), 0.05) << seed << ' ' << facet.id;
      }
    }
  }
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

// Eaves reach 0.8 m over a garden, before a wall with a balcony of 1 m.
TEST(OpenGround, ReachesBelowEavesToTheWallAndNotToItsBalcony) {
  RoofEvidence evidence;
  for (double x = 0.05; x < 10; x += 0.1) {
    for (double y = 0.05; y < 3.8; y += 0.1) evidence.samples.positions.emplace_back(x, y, 6);
    for (double y = 3.85; y < 9; y += 0.1) evidence.open.emplace_back(x, y);
  }
  const auto add_step = [&](double offset, double area) {
    RoofStep& step = evidence.steps.emplace_back();
    step.plane.role = PlaneRole::kWall;
    step.plane.normal = Eigen::Vector3d::UnitY();
    step.plane.offset = offset;
    step.plane.area = area;
  };
  add_step(4, 15);
  add_step(3, 90);
  PlaneRaster raster;
  raster.cell = 0.25;
  raster.width = raster.height = 40;
  const auto distances = DistancesToOpenGround(evidence, raster, kTolerances);
  ASSERT_EQ(distances.size(), 1600u);
  const auto at = [&](double x, double y) { return distances[raster.IndexAt({x, y})]; };
  EXPECT_EQ(at(5, 6), 0);
  EXPECT_EQ(at(5, 3.4), 0);
  EXPECT_GT(at(5, 2.7), 0);
  evidence.steps.erase(evidence.steps.begin());
  EXPECT_EQ(DistancesToOpenGround(evidence, raster, kTolerances), distances);
}

// A wall at y = 3 hides the ground up to y = 5, where it is seen from x = 2 to 8.
TEST(OpenGround, ReachesToTheWallThatHidesIt) {
  RoofEvidence evidence;
  for (double x = 0.05; x < 10; x += 0.1) {
    for (double y = 0.05; y < 3; y += 0.1) evidence.samples.positions.emplace_back(x, y, 6);
    for (double y = 5.05; y < 9; y += 0.1) evidence.open.emplace_back(x, y);
  }
  PlaneRaster raster;
  raster.cell = 0.25;
  raster.width = raster.height = 40;
  const auto is_open = [&](double x, double y) {
    return DistancesToOpenGround(evidence, raster, kTolerances)[raster.IndexAt({x, y})] == 0;
  };
  EXPECT_FALSE(is_open(5, 4));
  RoofStep& wall = evidence.steps.emplace_back();
  wall.plane.role = PlaneRole::kWall;
  wall.plane.normal = Eigen::Vector3d::UnitY();
  wall.plane.offset = 3;
  wall.from = -8;
  wall.to = -2;
  EXPECT_TRUE(is_open(5, 4));
  EXPECT_TRUE(is_open(5, 3.2));
  EXPECT_FALSE(is_open(5, 2.9));
  EXPECT_FALSE(is_open(1, 4));  // where no wall was seen
  // A shed between them says that something stands there.
  for (double x = 4; x < 6; x += 0.1) evidence.samples.positions.emplace_back(x, 4.5, 2.5);
  EXPECT_FALSE(is_open(5, 4.4));
  EXPECT_TRUE(is_open(7, 4.4));
}

}  // namespace
}  // namespace stucco
