// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/map/map_errors.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/proxy/map_scene.h"

namespace stucco {
namespace {

// A rectangle of this size whose walls stand where `motion` and `outset` put it.
HeldGroup RectangleGroup(const Eigen::Vector2d& middle, double width, double depth,
                         const GroupMotion& motion, double outset) {
  HeldGroup group{.middle = middle};
  const std::vector<Eigen::Vector2d> normals = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
  for (const Eigen::Vector2d& n : normals) {
    const double off = n.x() != 0 ? width / 2 : depth / 2;
    group.walls.push_back({.middle = middle + off * n,
                           .outwards = n,
                           .offset = outset + n.dot(motion.shift),
                           .turn = motion.turn,
                           .span = n.x() != 0 ? depth : width});
  }
  return group;
}

std::vector<HeldGroup> Town(const std::vector<GroupMotion>& motions, double outset) {
  std::vector<HeldGroup> groups;
  for (size_t g = 0; g < motions.size(); ++g) {
    groups.push_back(
        RectangleGroup({40.0 * static_cast<double>(g), 0}, 40, 24, motions[g], outset));
  }
  return groups;
}

MapPrior FirstPrior(size_t groups) {
  return {.done = std::vector<GroupMotion>(groups)};
}

TEST(MapErrors, TurnsAndShiftsEachGroup) {
  const std::vector<GroupMotion> truth = {
      {.shift = {0.3, -0.2}, .turn = 0.006}, {.shift = {-0.4, 0.1}, .turn = -0.004}, {}};
  const auto groups = Town(truth, -0.5);
  const MapErrors found = ErrorsOf(groups, FirstPrior(3));
  EXPECT_NEAR(found.outset, -0.5, 0.02);
  for (size_t g = 0; g < truth.size(); ++g) {
    EXPECT_LT((found.motions[g].shift - truth[g].shift).norm(), 0.03) << g;
    EXPECT_NEAR(found.motions[g].turn, truth[g].turn, 0.0008) << g;
  }
}

// Balconies along one wall make it look turned by a degree; the other three are not.
TEST(MapErrors, OneTurnedWallTurnsNoBuilding) {
  auto groups = Town({{}, {}, {}}, 0);
  groups[0].walls[1].turn = 0.0175;
  const MapErrors found = ErrorsOf(groups, FirstPrior(3));
  EXPECT_LT(std::abs(found.motions[0].turn), 0.003);
}

// A wall beside the middle of its group moves when the group is turned.
TEST(MapErrors, WallsFarFromTheMiddleTellATurn) {
  HeldGroup group{.middle = {0, 0}};
  const double turn = 0.008;
  for (const double x : {-30.0, -10.0, 10.0, 30.0}) {
    for (const double side : {1.0, -1.0}) {
      group.walls.push_back(
          {.middle = {x, side * 5}, .outwards = {0, side}, .offset = side * turn * x});
    }
  }
  const MapErrors found = ErrorsOf(std::vector<HeldGroup>{group}, FirstPrior(1));
  EXPECT_NEAR(found.motions[0].turn, turn, 0.001);
  const Eigen::Vector2d end = IsometryOf(found.motions[0], group.middle) * Eigen::Vector2d(30, 5);
  EXPECT_NEAR(end.y(), 5 + 30 * turn, 0.03);
}

// Where all others are turned alike, one without long walls is, too.
TEST(MapErrors, LearnsTheTurnOfTheMap) {
  auto groups = Town(std::vector<GroupMotion>(4, {.shift = {0, 0}, .turn = 0.005}), 0);
  for (HeldWall& wall : groups[3].walls) wall.span = wall.turn = 0;
  MapPrior prior = FirstPrior(4);
  MapErrors errors = ErrorsOf(groups, prior);
  EXPECT_NEAR(errors.motions[3].turn, 0, 1e-3);
  prior = Learned(groups, errors, prior);
  EXPECT_NEAR(prior.turn, 0.005, 0.0007);
  errors = ErrorsOf(Town(std::vector<GroupMotion>(4), 0), prior);
  EXPECT_NEAR(prior.done[0].turn + errors.motions[0].turn, 0.005, 0.0007);
  EXPECT_GT(errors.motions[3].turn, 0.0005);
}

// Each drawn by itself, and turned by itself by up to half a degree.
TEST(MapErrors, BuildingsOfAModelAreTurnedOneByOne) {
  const std::vector<Ring> rings = {test::Rectangle(-28, -15, 0, -7),
                                   test::Rectangle(6, -17, 16, 17),
                                   test::Rectangle(-26, 5, -2, 16)};
  const std::vector<double> turns_deg = {0.5, -0.4, 0.1};
  std::vector<test::House> houses;
  std::vector<test::MapEntry> map;
  for (size_t i = 0; i < rings.size(); ++i) {
    const std::string id = "B000" + std::to_string(i + 1);
    houses.push_back(test::FlatHouse(rings[i], 8));
    const Eigen::Vector2d middle = (rings[i][0] + rings[i][2]) / 2;
    Ring around = rings[i];
    for (Eigen::Vector2d& p : around) p -= middle;
    test::MapEntry entry = test::Displaced({{id, {around}, 8}}, turns_deg[i], {0.2, -0.1})[0];
    for (Eigen::Vector2d& p : entry.rings[0]) p += middle;
    map.push_back(entry);
  }
  const auto captured =
      test::Capture(houses, {test::GroundSquare(35)}, {.spacing = 0.2, .noise = 0.02});
  const test::MadeModel made = test::MakeModel(captured, map);
  for (size_t i = 0; i < rings.size(); ++i) {
    for (const Facet* roof : test::OfClass(test::ClosedIn(made, map[i].id), FacetClass::kRoof)) {
      for (const auto& p : roof->outer) {
        double nearest = 1e9;
        for (const auto& corner : rings[i]) {
          nearest = std::min(nearest, (corner - p.head<2>()).norm());
        }
        EXPECT_LT(nearest, 0.06) << map[i].id;
      }
    }
  }
}

// A cadastre measures corners one by one: each of these is off by 0.25 m.
TEST(MapErrors, WallsOfAModelAreTurnedOneByOne) {
  const Ring truth = test::Rectangle(-12, -6, 12, 6);
  Ring mapped = truth;
  mapped[0] += Eigen::Vector2d(0.1, 0.2);
  mapped[1] += Eigen::Vector2d(-0.2, -0.15);
  mapped[2] += Eigen::Vector2d(0.2, 0.15);
  mapped[3] += Eigen::Vector2d(-0.1, -0.2);
  const auto captured = test::Capture({test::FlatHouse(truth, 8)}, {test::GroundSquare(30)},
                                      {.spacing = 0.2, .noise = 0.02});
  const test::MadeModel made = test::MakeModel(captured, {{"B0001", {mapped}, 8}});
  const auto roofs = test::OfClass(test::ClosedIn(made, "B0001"), FacetClass::kRoof);
  ASSERT_EQ(roofs.size(), 1u);
  ASSERT_EQ(roofs[0]->outer.size(), 4u);
  for (const auto& p : roofs[0]->outer) {
    double nearest = 1e9;
    for (const auto& corner : truth) nearest = std::min(nearest, (corner - p.head<2>()).norm());
    EXPECT_LT(nearest, 0.08);
  }
}

}  // namespace
}  // namespace stucco
