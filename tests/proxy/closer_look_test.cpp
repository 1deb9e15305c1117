// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/map/closer_look.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "tests/proxy/map_scene.h"

namespace stucco {
namespace {

using test::Rectangle;
using testing::ElementsAre;
using testing::UnorderedElementsAre;

// Houses of 10 x 8 m in a row, one every so many metres.
std::vector<MapBuilding> HousesOf(size_t count, double every) {
  std::vector<MapBuilding> buildings(count);
  for (size_t b = 0; b < count; ++b) {
    const double x = every * static_cast<double>(b);
    buildings[b].parts = {{{Rectangle(x, 0, x + 10, 8)}}};
  }
  return buildings;
}

// A hundred samples in the middle of each, 15 cm apart, where details ask for half as much: four
// times as many.
PlanarScene RowOfHouses(size_t count, double every) {
  PlanarScene scene;
  scene.samples.cell = 0.15;
  scene.tolerances.level_of_detail = 0.3;
  for (const MapBuilding& building : HousesOf(count, every)) {
    const double x = BoundsOf(building, 0).center().x();
    for (int i = 0; i < 100; ++i) scene.samples.positions.emplace_back(x, 0.08 * i, 3);
  }
  scene.samples.normals.resize(100 * count, Eigen::Vector3d::UnitZ());
  scene.samples.weights.resize(100 * count, 100);
  return scene;
}

std::vector<std::vector<size_t>> MembersOf(const std::vector<SetOfBuildings>& sets) {
  std::vector<std::vector<size_t>> members;
  for (const SetOfBuildings& set : sets) members.push_back(set.members);
  return members;
}

TEST(SetsOfBuildings, KeepNeighboursTogetherAndSamplesFew) {
  auto buildings = HousesOf(4, 100);
  buildings[1].parts = {{{Rectangle(10, 0, 20, 8)}}};  // wall to wall with the first
  PlanarScene scene = RowOfHouses(4, 100);
  for (int i = 100; i < 200; ++i) scene.samples.positions[i].x() = 15;
  const UprightSurvey survey = UprightSurveyOf(scene);
  EXPECT_THAT(MembersOf(SetsOfBuildings(survey, buildings, 1000)),
              UnorderedElementsAre(ElementsAre(0, 1), ElementsAre(2, 3)));
  EXPECT_THAT(MembersOf(SetsOfBuildings(survey, buildings, 700)),
              UnorderedElementsAre(ElementsAre(0), ElementsAre(1), ElementsAre(2), ElementsAre(3)));
  EXPECT_THAT(MembersOf(SetsOfBuildings(survey, buildings, 10000)),
              ElementsAre(ElementsAre(0, 1, 2, 3)));
}

// A cloud of few points gets no more samples by looking closer.
TEST(SetsOfBuildings, ExpectNoMoreSamplesThanPoints) {
  PlanarScene scene = RowOfHouses(2, 100);
  scene.samples.weights.assign(scene.samples.size(), 2);
  const auto sets = SetsOfBuildings(UprightSurveyOf(scene), HousesOf(2, 100), 450);
  EXPECT_THAT(MembersOf(sets), ElementsAre(ElementsAre(0, 1)));
}

// A terrace too long for one set is cut, and each piece knows the house beside it.
TEST(SetsOfBuildings, CutRowsThatAreTooLong) {
  const auto sets = SetsOfBuildings(UprightSurveyOf(RowOfHouses(9, 10)), HousesOf(9, 10), 3000);
  ASSERT_GT(sets.size(), 1u);
  std::vector<size_t> all;
  for (const SetOfBuildings& set : sets) {
    ASSERT_FALSE(set.members.empty());
    EXPECT_LE(set.members.size(), 4u);
    all.insert(all.end(), set.members.begin(), set.members.end());
    const size_t first = set.members.front(), last = set.members.back();
    EXPECT_EQ(last - first + 1, set.members.size()) << "not in a row";
    std::vector<size_t> beside;
    if (first > 0) beside.push_back(first - 1);
    if (last < 8) beside.push_back(last + 1);
    EXPECT_EQ(set.beside, beside);
  }
  std::ranges::sort(all);
  EXPECT_THAT(all, ElementsAre(0, 1, 2, 3, 4, 5, 6, 7, 8));
}

// Sets are of buildings near each other, whatever order the map has them in.
TEST(SetsOfBuildings, AreNearEachOther) {
  auto buildings = HousesOf(8, 100);
  std::vector<MapBuilding> shuffled;
  for (const size_t b : {0, 4, 1, 5, 2, 6, 3, 7}) shuffled.push_back(buildings[b]);
  const auto sets = SetsOfBuildings(UprightSurveyOf(RowOfHouses(8, 100)), shuffled, 800);
  ASSERT_THAT(sets, testing::SizeIs(4));
  for (const SetOfBuildings& set : sets) {
    ASSERT_THAT(set.members, testing::SizeIs(2));
    const double apart = (BoundsOf(shuffled[set.members[0]], 0).center() -
                          BoundsOf(shuffled[set.members[1]], 0).center())
                             .norm();
    EXPECT_NEAR(apart, 100, 1e-9);
  }
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
  scene.samples.weights.resize(300, 100);
  const UprightSurvey survey = UprightSurveyOf(scene);
  EXPECT_THAT(MembersOf(SetsOfBuildings(survey, buildings, 1000)),
              UnorderedElementsAre(ElementsAre(0), ElementsAre(1, 2)));
}

}  // namespace
}  // namespace stucco
