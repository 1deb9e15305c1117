// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/map/closer_look.h"

#include <gtest/gtest.h>

#include <vector>

#include "tests/proxy/map_scene.h"

namespace stucco {
namespace {

using test::Rectangle;

TEST(SetsOfBuildings, KeepNeighboursTogetherAndSamplesFew) {
  PlanarScene scene;
  scene.samples.cell = 0.15;
  scene.tolerances.level_of_detail = 0.3;  // which asks for samples 0.075 m apart: four times these
  std::vector<MapBuilding> buildings;
  for (int b = 0; b < 4; ++b) {
    const double x = b < 2 ? 10 * b : 100 * b;  // the first two stand wall to wall
    MapBuilding& building = buildings.emplace_back();
    building.parts = {{{Rectangle(x, 0, x + 10, 8)}}};
    for (int i = 0; i < 100; ++i) scene.samples.positions.emplace_back(x + 5, 0.08 * i, 3);
  }
  scene.samples.normals.resize(400, Eigen::Vector3d::UnitZ());
  const UprightSurvey survey = UprightSurveyOf(scene);
  using Sets = std::vector<std::vector<size_t>>;
  EXPECT_EQ(SetsOfBuildings(survey, buildings, 1600), (Sets{{0, 1}, {2, 3}}));
  EXPECT_EQ(SetsOfBuildings(survey, buildings, 1000), (Sets{{0, 1}, {2, 3}}));
  EXPECT_EQ(SetsOfBuildings(survey, buildings, 500), (Sets{{0, 1}, {2}, {3}}));
  EXPECT_EQ(SetsOfBuildings(survey, buildings, 10000), (Sets{{0, 1, 2, 3}}));
}

// Bounds of houses that stand aslant overlap across an alley: that makes no neighbours.
TEST(SetsOfBuildings, GoByOutlinesNotByTheirBounds) {
  PlanarScene scene;
  scene.samples.cell = 0.15;
  scene.tolerances.level_of_detail = 0.3;
  const auto aslant = [](double x, double y) {
    return Ring{{x, y}, {x + 10, y + 10}, {x + 6, y + 14}, {x - 4, y + 4}};
  };
  std::vector<MapBuilding> buildings(3);
  buildings[0].parts = {{{aslant(0, 0)}}};
  buildings[1].parts = {{{aslant(8, -8)}}};  // 3 m apart at the nearest, bounds overlap
  buildings[2].parts = {{{aslant(18, 2)}}};  // goes on where the second ends
  for (const MapBuilding& building : buildings) {
    const Eigen::Vector2d middle = BoundsOf(building, 0).center();
    for (int i = 0; i < 100; ++i) {
      scene.samples.positions.emplace_back(middle.x() + 0.01 * i, middle.y(), 3);
    }
  }
  scene.samples.normals.resize(300, Eigen::Vector3d::UnitZ());
  const UprightSurvey survey = UprightSurveyOf(scene);
  using Sets = std::vector<std::vector<size_t>>;
  EXPECT_EQ(SetsOfBuildings(survey, buildings, 1), (Sets{{0}, {1, 2}}));
}

}  // namespace
}  // namespace stucco
