// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "site/facades.h"

#include <gtest/gtest.h>

#include <chrono>

#include "tests/site/made_site.h"

namespace stucco {
namespace {

std::vector<std::string> Ids(const std::vector<Facade>& facades) {
  std::vector<std::string> ids;
  for (const Facade& facade : facades) ids.push_back(facade.id);
  return ids;
}

using Strings = std::vector<std::string>;

Footprint Part(const std::string& building, const Ring& ring, Interval z) {
  return {.building = building,
          .outline = {{ring}},
          .z_m = z,
          .top_known = true,
          .blocked_to_m = z.to_m + 10};
}

const Facade& Find(const std::vector<Facade>& facades, const std::string& id) {
  for (const Facade& facade : facades) {
    if (facade.id == id) return facade;
  }
  throw std::out_of_range(id);
}

TEST(FromSouthWest, StartsAnywhereGivesTheSameRing) {
  Ring ring = Rectangle(0, 0, 4, 3);
  const Ring expected = ring;
  for (int i = 0; i < 4; ++i) {
    std::rotate(ring.begin(), ring.begin() + 1, ring.end());
    EXPECT_EQ(FromSouthWest(ring), expected);
  }
}

TEST(MakeFacades, EveryEdgeOfAFreeBuildingCourtyardsToo) {
  const Site site = MadeSite(
      std::vector<Polygon>{{{Rectangle(0, 0, 40, 30), Reversed(Rectangle(10, 10, 30, 20))}}});
  EXPECT_EQ(Ids(site.facades), (Strings{"B0001/F00", "B0001/F01", "B0001/F02", "B0001/F03",
                                        "B0001/F04", "B0001/F05", "B0001/F06", "B0001/F07"}));
  const Facade& south = site.facades[0];
  EXPECT_EQ(south.a, Eigen::Vector2d(0, 0));
  EXPECT_EQ(south.b, Eigen::Vector2d(40, 0));
  EXPECT_EQ(south.normal(), Eigen::Vector2d(0, -1));
  EXPECT_EQ(south.z_m, (Interval{0, 50}));
  EXPECT_FALSE(south.top_known);
  // From the courtyard's south-west corner clockwise: its west wall, which faces east.
  EXPECT_EQ(site.facades[4].a, Eigen::Vector2d(10, 10));
  EXPECT_EQ(site.facades[4].normal(), Eigen::Vector2d(1, 0));
}

TEST(MakeFacades, PartyWallsAreNone) {
  const Site site = MadeSite(std::vector<Ring>{Rectangle(0, 0, 10, 10), Rectangle(10, 0, 20, 10)});
  EXPECT_EQ(Ids(site.facades), (Strings{"B0001/F00", "B0001/F02", "B0001/F03", "B0002/F00",
                                        "B0002/F01", "B0002/F02"}));
}

TEST(MakeFacades, TheHigherBuildingShowsAboveItsNeighbour) {
  const auto facades = [](double low, double high) {
    return MadeSite(std::vector<Ring>{Rectangle(0, 0, 10, 10), Rectangle(10, 0, 20, 10)},
                    {.heights_m = {low, high}})
        .facades;
  };
  EXPECT_EQ(Ids(facades(10, 25)), (Strings{"B0001/F00", "B0001/F02", "B0001/F03", "B0002/F00",
                                           "B0002/F01", "B0002/F02", "B0002/F03"}));
  EXPECT_EQ(Find(facades(10, 25), "B0002/F03").z_m, (Interval{10, 25}));
  EXPECT_EQ(facades(10, 10.9).size(), 6u);  // from a metre on
  EXPECT_EQ(facades(10, 11).size(), 7u);
  EXPECT_EQ(facades(0, 25).size(), 6u);  // a height that is not known tells nothing
  EXPECT_EQ(facades(10, 0).size(), 6u);
}

// What stands on the ground has the ids that it has beside a neighbour of any height.
TEST(MakeFacades, WallsAboveNeighboursComeLast) {
  const std::vector<Ring> rings = {Rectangle(0, 0, 10, 30), Rectangle(10, 0, 20, 18)};
  const auto unknown = MadeSite(rings, {.heights_m = {30, 0}}).facades;
  const auto known = MadeSite(rings, {.heights_m = {30, 8}}).facades;
  EXPECT_EQ(known.size(), unknown.size() + 1);
  for (const Facade& facade : unknown) {
    EXPECT_EQ(Find(known, facade.id).a, facade.a) << facade.id;
    EXPECT_EQ(Find(known, facade.id).b, facade.b) << facade.id;
  }
  EXPECT_EQ(Find(known, "B0001/F01").z_m, (Interval{0, 30}));
  EXPECT_EQ(Find(known, "B0001/F01").a, Eigen::Vector2d(10, 18));
  EXPECT_EQ(Find(known, "B0001/F01b").z_m, (Interval{8, 30}));
  EXPECT_EQ(Find(known, "B0001/F01b").b, Eigen::Vector2d(10, 18));
}

// The ground under a neighbour up the slope is no wall.
TEST(MakeFacades, NothingShowsBelowANeighbour) {
  const auto facades = MakeFacades({Part("B0001", Rectangle(0, 0, 10, 10), {0, 20}),
                                    Part("B0002", Rectangle(10, 0, 20, 10), {4, 12})});
  EXPECT_EQ(facades.size(), 7u);
  EXPECT_EQ(Find(facades, "B0001/F01").z_m, (Interval{12, 20}));
}

TEST(MakeFacades, ObstaclesHideNoPartOfAWall) {
  auto footprints = std::vector{Part("B0001", Rectangle(0, 0, 10, 10), {0, 8}),
                                Part("O0001", Rectangle(10, 0, 20, 10), {0, 8})};
  footprints[1].in_area = false;
  footprints[1].is_obstacle = true;
  EXPECT_EQ(Ids(MakeFacades(footprints)),
            (Strings{"B0001/F00", "B0001/F01", "B0001/F02", "B0001/F03"}));
}

TEST(MakeFacades, WallsWithin5CmAreOne) {
  const auto count = [](double gap) {
    return MadeSite(std::vector<Ring>{Rectangle(0, 0, 10, 10), Rectangle(10 + gap, 0, 20, 10)})
        .facades.size();
  };
  EXPECT_EQ(count(0.04), 6u);
  EXPECT_EQ(count(0.06), 8u);
}

TEST(MakeFacades, SharedPartOfAnEdgeIsCutOut) {
  const Site site = MadeSite(std::vector<Ring>{Rectangle(0, 0, 10, 30), Rectangle(10, 12, 20, 18)});
  EXPECT_EQ(Ids(site.facades), (Strings{"B0001/F00", "B0001/F01", "B0001/F01b", "B0001/F02",
                                        "B0001/F03", "B0002/F00", "B0002/F01", "B0002/F02"}));
  EXPECT_EQ(Find(site.facades, "B0001/F01").a, Eigen::Vector2d(10, 0));
  EXPECT_EQ(Find(site.facades, "B0001/F01").b, Eigen::Vector2d(10, 12));
  EXPECT_EQ(Find(site.facades, "B0001/F01b").a, Eigen::Vector2d(10, 18));
  EXPECT_EQ(Find(site.facades, "B0001/F01b").b, Eigen::Vector2d(10, 30));
}

TEST(MakeFacades, ANeighbourChangesNoOtherId) {
  const Site alone = MadeSite(std::vector<Ring>{Rectangle(0, 0, 10, 10)});
  const Site beside =
      MadeSite(std::vector<Ring>{Rectangle(0, 0, 10, 10), Rectangle(10, 0, 20, 10)});
  for (const std::string id : {"B0001/F00", "B0001/F02", "B0001/F03"}) {
    EXPECT_EQ(Find(alone.facades, id).a, Find(beside.facades, id).a);
    EXPECT_EQ(Find(alone.facades, id).b, Find(beside.facades, id).b);
  }
}

// A corner on a straight wall joins a neighbour to it: it starts no new wall.
TEST(MakeFacades, IdsCountWallsFromCornerToCorner) {
  const Site site = MadeSite(std::vector<Ring>{
      {{0, 0}, {10, 0}, {10, 12}, {10, 18}, {10, 30}, {0, 30}}, Rectangle(10, 12, 20, 18)});
  EXPECT_EQ(Ids(site.facades), (Strings{"B0001/F00", "B0001/F01", "B0001/F01b", "B0001/F02",
                                        "B0001/F03", "B0002/F00", "B0002/F01", "B0002/F02"}));
  EXPECT_EQ(Find(site.facades, "B0001/F01").b, Eigen::Vector2d(10, 12));
  EXPECT_EQ(Find(site.facades, "B0001/F01b").a, Eigen::Vector2d(10, 18));
}

TEST(MakeFacades, WallsThatOnlyMeetAtACornerStay) {
  const Site corner =
      MadeSite(std::vector<Ring>{Rectangle(0, 0, 10, 10), Rectangle(10, 10, 20, 20)});
  EXPECT_EQ(corner.facades.size(), 8u);
  // Perpendicular and touching in a point of the wall.
  const Site touching =
      MadeSite(std::vector<Ring>{Rectangle(0, 0, 10, 10), {{10, 5}, {14, 1}, {18, 5}, {14, 9}}});
  EXPECT_EQ(touching.facades.size(), 8u);
}

TEST(MakeFacades, PartsOfOneBuildingShowAboveEachOther) {
  const auto facades = MakeFacades({Part("B0001", Rectangle(0, 0, 10, 10), {0, 8}),
                                    Part("B0001", Rectangle(10, 0, 20, 10), {0, 20})});
  EXPECT_EQ(facades.size(), 7u);
  EXPECT_EQ(Find(facades, "B0001/F07").z_m, (Interval{8, 20}));
  EXPECT_EQ(Find(facades, "B0001/F04").z_m, (Interval{0, 20}));
}

TEST(MakeFacades, UpperWallMayVaryAlongAnEdge) {
  // A 30 m tower whose west wall meets a part of 10 m, then one of 20 m, then stands free.
  const auto facades = MakeFacades({Part("B0001", Rectangle(10, 0, 20, 30), {0, 30}),
                                    Part("B0001", Rectangle(0, 20, 10, 30), {0, 10}),
                                    Part("B0001", Rectangle(0, 10, 10, 20), {0, 20})});
  const Facade& first = Find(facades, "B0001/F03");
  EXPECT_EQ(first.a, Eigen::Vector2d(10, 30));
  EXPECT_EQ(first.b, Eigen::Vector2d(10, 20));
  EXPECT_EQ(first.z_m, (Interval{10, 30}));
  EXPECT_EQ(Find(facades, "B0001/F03b").z_m, (Interval{20, 30}));
  EXPECT_EQ(Find(facades, "B0001/F03c").z_m, (Interval{0, 30}));
  EXPECT_EQ(Find(facades, "B0001/F03c").b, Eigen::Vector2d(10, 0));
}

TEST(MakeFacades, APartThatStandsOnAnotherKeepsAllItsWalls) {
  const auto facades = MakeFacades({Part("B0001", Rectangle(0, 0, 30, 30), {0, 10}),
                                    Part("B0001", Rectangle(0, 0, 15, 15), {10, 40})});
  EXPECT_EQ(facades.size(), 8u);
  EXPECT_EQ(Find(facades, "B0001/F04").z_m, (Interval{10, 40}));
}

TEST(MakeFacades, ABridgeBetweenTowersLeavesWallsBelowAndAbove) {
  const auto facades = MakeFacades({Part("B0001", Rectangle(0, 0, 10, 10), {0, 40}),
                                    Part("B0001", Rectangle(10, 0, 20, 10), {20, 24})});
  EXPECT_EQ(Find(facades, "B0001/F01").z_m, (Interval{0, 20}));
  EXPECT_EQ(Find(facades, "B0001/F01b").z_m, (Interval{24, 40}));
}

TEST(MakeFacades, ObstaclesHaveNoneButStillMakePartyWalls) {
  auto footprints = std::vector{Part("B0001", Rectangle(0, 0, 10, 10), {0, 8}),
                                Part("B0002", Rectangle(10, 0, 20, 10), {0, 8})};
  footprints[1].in_area = false;
  const auto facades = MakeFacades(footprints);
  EXPECT_EQ(Ids(facades), (Strings{"B0001/F00", "B0001/F02", "B0001/F03"}));
}

TEST(MakeFacades, KerbsAreNoWalls) {
  EXPECT_EQ(MakeFacades({Part("B0001", Rectangle(0, 0, 30, 30), {0, 0.6})}).size(), 4u);
  EXPECT_TRUE(MakeFacades({Part("B0001", Rectangle(0, 0, 30, 30), {0, 0.4})}).empty());
  const auto facades = MakeFacades({Part("B0001", Rectangle(0, 0, 10, 10), {0, 8}),
                                    Part("B0001", Rectangle(10, 0, 20, 10), {0, 8.9})});
  EXPECT_EQ(facades.size(), 6u);
}

TEST(MakeFacades, NothingFromNothing) {
  EXPECT_TRUE(MakeFacades({}).empty());
}

TEST(MakeFacades, GrowsWithTheTownNotWithItsSquare) {
  const auto town = RandomTown(1, 20000);
  std::vector<Footprint> footprints;
  for (size_t i = 0; i < town.size(); ++i) {
    footprints.push_back(Part("B" + std::to_string(i), town[i], {0, 10}));
  }
  size_t edges = 0;
  for (const Ring& ring : town) edges += ring.size();
  const auto start = std::chrono::steady_clock::now();
  EXPECT_EQ(MakeFacades(footprints).size(), edges);
  // 100 000 edges take a quarter of a second; all pairs would take minutes.
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(10));
}

}  // namespace
}  // namespace stucco
