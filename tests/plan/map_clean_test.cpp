// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <numbers>
#include <random>

#include "plan/map/clean.h"
#include "plan/map/internal/noding.h"
#include "plan/map/internal/ogr.h"
#include "site/facades.h"
#include "site/ground.h"
#include "survey/geometry2d.h"
#include "tests/site/made_site.h"

namespace stucco::plan {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

MapFeature Feature(const std::string& building, const std::vector<Ring>& rings,
                   std::optional<double> height = {}) {
  return {.building = building, .polygons = {{rings}}, .height_m = height};
}

MapFeature Part(const std::string& name, const Ring& ring, double low, double high) {
  MapFeature part = Feature(name, {ring}, high);
  part.is_part = true;
  part.min_height_m = low;
  return part;
}

double AreaOf(const CleanedMap& map, const std::string& building) {
  double area = 0;
  for (const Footprint& footprint : map.footprints) {
    if (footprint.building == building) area += Area(footprint.outline);
  }
  return area;
}

std::vector<Facade> FacadesOf(const CleanedMap& map) {
  Site site;
  site.safe_altitude_m = 60;
  site.footprints = map.footprints;
  PlaceOnGround(site);
  return MakeFacades(site.footprints);
}

// What CleanMap promises: checked pair by pair with exact predicates.
void ExpectClean(const CleanedMap& map) {
  for (const Footprint& a : map.footprints) {
    for (size_t r = 0; r < a.outline.rings.size(); ++r) {
      const Ring& ring = a.outline.rings[r];
      EXPECT_EQ(SignedArea(ring) > 0, r == 0);
      for (const Eigen::Vector2d& corner : ring) {
        EXPECT_NEAR(corner.x() * 1000, std::round(corner.x() * 1000), 1e-6);
        for (const Footprint& b : map.footprints) {
          if (&a == &b) continue;
          for (const Ring& other : b.outline.rings) {
            for (size_t i = 0; i < other.size(); ++i) {
              const Eigen::Vector2d& p = other[i];
              const Eigen::Vector2d& q = other[(i + 1) % other.size()];
              if (corner == p || corner == q) continue;
              EXPECT_GT(Distance(Segment2d{p, q}, corner), 0.03)
                  << a.building << " at a wall of " << b.building;
            }
          }
        }
      }
    }
  }
  for (size_t i = 0; i < map.footprints.size(); ++i) {
    EXPECT_TRUE(internal::ToOgr(map.footprints[i].outline)->IsValid());
    for (size_t k = 0; k < i; ++k) {
      const Footprint& a = map.footprints[i];
      const Footprint& b = map.footprints[k];
      if (a.building == b.building && (a.z_m.to_m <= b.z_m.from_m || b.z_m.to_m <= a.z_m.from_m)) {
        continue;
      }
      EXPECT_FALSE(internal::InteriorsMeet(a.outline, b.outline)) << a.building << b.building;
    }
  }
}

TEST(Tidied, DropsRepeatsAndSpikes) {
  const Ring square = Rectangle(0, 0, 10, 10);
  EXPECT_EQ(internal::Tidied(square), square);
  EXPECT_EQ(internal::Tidied({{0, 0}, {0, 0}, {10, 0}, {10, 10}, {10, 10}, {0, 10}, {0, 0}}),
            square);
  EXPECT_EQ(internal::Tidied({{0, 0}, {10, 0}, {20, 0}, {10, 0}, {10, 10}, {0, 10}}), square);
  EXPECT_LT(internal::Tidied({{0, 0}, {1, 1}, {0, 0}}).size(), 3u);
  EXPECT_TRUE(internal::Tidied({}).empty());
}

TEST(Simplified, KeepsWithinTheTolerance) {
  const Ring ring = {{0, 0}, {5, 0.04}, {10, 0}, {10, 5}, {10.2, 7}, {10, 10}, {0, 10}};
  const Ring expected = {{0, 0}, {10, 0}, {10, 5}, {10.2, 7}, {10, 10}, {0, 10}};
  EXPECT_EQ(internal::Simplified(ring, 0.05), expected);
  Ring circle;
  for (int i = 0; i < 720; ++i) {
    circle.push_back(
        {10 * std::cos(i * std::numbers::pi / 360), 10 * std::sin(i * std::numbers::pi / 360)});
  }
  const Ring few = internal::Simplified(circle, 0.05);
  EXPECT_LT(few.size(), 60u);
  for (const Eigen::Vector2d& corner : circle) {
    double nearest = 1;
    for (size_t i = 0; i < few.size(); ++i) {
      nearest = std::min(nearest, Distance(Segment2d{few[i], few[(i + 1) % few.size()]}, corner));
    }
    EXPECT_LE(nearest, 0.05);
  }
}

TEST(CleanMap, LeavesACleanMapAlone) {
  const CleanedMap map = CleanMap({Feature("B0001", {Rectangle(0, 0, 10, 10)}, 9),
                                   Feature("B0002", {Rectangle(10, 0, 20, 10)})});
  ASSERT_EQ(map.footprints.size(), 2u);
  EXPECT_EQ(map.footprints[0].outline.rings[0], Rectangle(0, 0, 10, 10));
  EXPECT_EQ(map.footprints[0].z_m, (Interval{0, 9}));
  EXPECT_TRUE(map.footprints[0].top_known);
  EXPECT_FALSE(map.footprints[1].top_known);
  EXPECT_THAT(map.repairs.Lines(), IsEmpty());
  EXPECT_TRUE(CleanMap({}).footprints.empty());
}

TEST(CleanMap, TurnsClosesAndRepairsContours) {
  MapFeature open = Feature("B0002", {Rectangle(20, 0, 30, 10)});
  open.has_open_ring = true;
  const CleanedMap map =
      CleanMap({Feature("B0001", {Reversed(Rectangle(0, 0, 10, 10))}), open,
                Feature("B0003", {{{40, 0}, {50, 10}, {50, 0}, {40, 10}}}),
                Feature("B0004", {Rectangle(60, 0, 80, 20), Rectangle(65, 5, 75, 15)})});
  ExpectClean(map);
  EXPECT_NEAR(AreaOf(map, "B0001"), 100, 1e-9);
  EXPECT_NEAR(AreaOf(map, "B0003"), 50, 1e-9);  // both triangles of the bow tie
  EXPECT_NEAR(AreaOf(map, "B0004"), 300, 1e-9);
  EXPECT_THAT(map.repairs.Lines(), ElementsAre("B0002: contour was open; closed",
                                               "B0003: contour crosses itself; repaired"));
}

TEST(CleanMap, DropsWhatIsNoBuilding) {
  const double nan = std::nan("");
  const CleanedMap map = CleanMap(
      {Feature("B0001", {Rectangle(0, 0, 0.9, 1)}), Feature("B0002", {Rectangle(10, 0, 60, 0.1)}),
       Feature("B0003", {{{0, 20}, {10, 20}, {20, 20}}}),
       Feature("B0004", {{{0, 0}, {nan, 0}, {1, 1}}}), Feature("B0005", {{{0, 0}, {1, 1}}}),
       Feature("B0006", {Rectangle(0, 40, 20, 60), Reversed(Rectangle(5, 45, 5.9, 46))})});
  ASSERT_EQ(map.footprints.size(), 1u);
  EXPECT_EQ(map.footprints[0].outline.rings.size(), 1u);
  const auto lines = map.repairs.Lines();
  EXPECT_THAT(lines, testing::Contains("B0001: under 1 m2 or 20 cm width; left out"));
  EXPECT_THAT(lines, testing::Contains("B0002: under 1 m2 or 20 cm width; left out"));
  EXPECT_THAT(lines, testing::Contains("B0004: a contour without area or place left out"));
  EXPECT_THAT(lines, testing::Contains("B0005: a contour without area or place left out"));
  EXPECT_THAT(lines, testing::Contains("B0006: holes of less than 1 m2 filled"));
}

TEST(CleanMap, DuplicatesGoAndTheHigherHeightStays) {
  const CleanedMap map = CleanMap({Feature("B0001", {Rectangle(0, 0, 10, 10)}, 9),
                                   Feature("B0002", {Rectangle(0.02, 0, 10, 10.1)}, 12),
                                   Feature("B0003", {Rectangle(2, 2, 6, 6)})});
  ASSERT_EQ(map.footprints.size(), 1u);
  EXPECT_EQ(map.footprints[0].z_m.to_m, 12);
  EXPECT_THAT(map.repairs.Lines(),
              ElementsAre("B0002: has the same outline as B0001; left out",
                          "B0003: lies inside B0001; left out", HasSubstr("1 corners moved")));
}

TEST(CleanMap, OverlapsAreCutOffTheSmallerBuilding) {
  const CleanedMap map = CleanMap(
      {Feature("B0001", {Rectangle(8, 0, 14, 10)}), Feature("B0002", {Rectangle(0, 0, 10, 10)})});
  ExpectClean(map);
  EXPECT_NEAR(AreaOf(map, "B0002"), 100, 1e-6);
  EXPECT_NEAR(AreaOf(map, "B0001"), 40, 1e-6);
  EXPECT_THAT(map.repairs.Lines(), ElementsAre("B0001: overlaps B0002 by 20 m2; cut off"));
  EXPECT_EQ(FacadesOf(map).size(), 6u);
}

TEST(CleanMap, ATowerInsideABuildingIsAPartOfIt) {
  const CleanedMap map = CleanMap({Feature("B0001", {Rectangle(0, 0, 40, 40)}, 10),
                                   Feature("B0002", {Rectangle(10, 10, 20, 20)}, 50)});
  ExpectClean(map);
  EXPECT_NEAR(AreaOf(map, "B0001"), 1600, 1e-6);
  EXPECT_THAT(map.repairs.Lines(),
              ElementsAre("B0002: stands inside B0001 and rises above it; made a part of it"));
  int upper = 0;
  for (const Facade& facade : FacadesOf(map)) upper += facade.z_m == Interval{10, 50};
  EXPECT_EQ(upper, 4);
}

TEST(CleanMap, PartsTakeThePlaceOfTheOutline) {
  const CleanedMap map = CleanMap(
      {Feature("B0001", {Rectangle(0, 0, 30, 10)}, 20),
       Part("B0007", Rectangle(0, 0, 10, 10), 0, 8), Part("B0008", Rectangle(10, 0, 20, 10), 0, 20),
       Part("B0009", Rectangle(2, 2, 8, 8), 8, 15), Part("B0010", Rectangle(50, 0, 60, 10), 0, 5)});
  ExpectClean(map);
  std::vector<std::string> names;
  for (const Footprint& footprint : map.footprints) names.push_back(footprint.building);
  EXPECT_THAT(names, ElementsAre("B0001", "B0001", "B0001", "B0001", "B0010"));
  EXPECT_NEAR(Area(map.footprints[0].outline), 100, 1e-6);  // 20 to 30 m
  EXPECT_EQ(map.footprints[3].z_m, (Interval{8, 15}));
  EXPECT_THAT(map.repairs.Lines(),
              ElementsAre("B0010: a part outside any building; taken as a building"));
  const auto facades = FacadesOf(map);
  int upper = 0;
  for (const Facade& facade : facades) upper += facade.z_m == Interval{8, 20};
  EXPECT_EQ(upper, 1);
}

// A house with a tower on its roof, drawn as an outline and a part that begins at 6 m; whether the
// outline says its own height or that of the tower.
TEST(CleanMap, BelowARaisedPartStandsItsHouse) {
  for (const double height : {6.0, 15.0}) {
    const CleanedMap map = CleanMap({Feature("B0001", {Rectangle(0, 0, 20, 10)}, height),
                                     Part("B0002", Rectangle(4, 2, 10, 8), 6, 15)});
    ExpectClean(map);
    double ground = 0, tower = 0;
    for (const Footprint& footprint : map.footprints) {
      EXPECT_EQ(footprint.building, "B0001");
      (footprint.z_m.from_m > 0 ? tower : ground) += Area(footprint.outline);
    }
    EXPECT_NEAR(ground, 200, 1e-6);
    EXPECT_NEAR(tower, 36, 1e-6);
    int walls = 0;
    for (const Facade& facade : FacadesOf(map)) walls += facade.z_m == Interval{6, 15};
    EXPECT_EQ(walls, height == 6 ? 4 : 0);  // beside the tower the house may be as high
    for (const Facade& facade : FacadesOf(map)) {
      EXPECT_FALSE(facade.z_m.from_m == 0 && facade.a.x() > 1 && facade.a.x() < 19)
          << "a wall inside of the house";
    }
  }
}

TEST(CleanMap, ARaisedBuildingInsideAnotherIsItsTower) {
  MapFeature tower = Feature("B0002", {Rectangle(4, 2, 10, 8)}, 15);
  tower.min_height_m = 6;
  const CleanedMap map = CleanMap({Feature("B0001", {Rectangle(0, 0, 20, 10)}, 6), tower});
  ExpectClean(map);
  EXPECT_NEAR(AreaOf(map, "B0001"), 200 + 36, 1e-6);
  ASSERT_EQ(map.footprints.size(), 2u);
  EXPECT_EQ(map.footprints[0].outline.rings.size(), 1u);
}

// Parts that make up the whole outline: below the one in the middle one walks through.
TEST(CleanMap, PartsAloneSayWhereAPassageIs) {
  const CleanedMap map = CleanMap({Feature("B0001", {Rectangle(0, 0, 30, 10)}, 9),
                                   Part("B0002", Rectangle(0, 0, 12, 10), 0, 9),
                                   Part("B0003", Rectangle(12, 0, 18, 10), 4, 9),
                                   Part("B0004", Rectangle(18, 0, 30, 10), 0, 9)});
  ExpectClean(map);
  ASSERT_EQ(map.footprints.size(), 3u);
  for (const Footprint& footprint : map.footprints) {
    const bool is_passage = footprint.outline.rings[0][0].x() == 12;
    EXPECT_EQ(footprint.z_m.from_m, is_passage ? 4 : 0);
  }
}

TEST(CleanMap, OverlappingPartsLeaveTheHigherOne) {
  const CleanedMap map = CleanMap({Feature("B0001", {Rectangle(0, 0, 30, 30)}, 30),
                                   Part("B0002", Rectangle(0, 0, 30, 30), 0, 10),
                                   Part("B0003", Rectangle(10, 10, 20, 20), 0, 30)});
  ExpectClean(map);
  ASSERT_EQ(map.footprints.size(), 2u);
  EXPECT_EQ(map.footprints[0].outline.rings.size(), 2u);
  EXPECT_EQ(map.footprints[1].z_m.to_m, 30);
}

// A dormer from 8 to 12 m mostly over a house of 10 m, the rest hanging over its wall.
TEST(CleanMap, PartsThatBeginHigherUpStandOnOthers) {
  const CleanedMap map = CleanMap({Feature("B0001", {Rectangle(0, 0, 20, 10)}, 12),
                                   Part("B0002", Rectangle(0, 0, 20, 10), 0, 10),
                                   Part("B0003", Rectangle(5, 7, 10, 12), 8, 12)});
  ExpectClean(map);
  ASSERT_EQ(map.footprints.size(), 3u);
  EXPECT_EQ(map.footprints[0].outline.rings.size(), 1u);
  EXPECT_NEAR(Area(map.footprints[0].outline), 200, 1e-6);
  EXPECT_EQ(map.footprints[1].z_m, (Interval{8, 12}));
  EXPECT_NEAR(Area(map.footprints[1].outline), 10, 1e-6);
  EXPECT_EQ(map.footprints[2].z_m, (Interval{10, 12}));
  EXPECT_NEAR(Area(map.footprints[2].outline), 15, 1e-6);
}

TEST(CleanMap, PartyWallsMeetAgainDespiteCentimetres) {
  const CleanedMap map = CleanMap({Feature("B0001", {Rectangle(0, 0, 10, 30)}),
                                   Feature("B0002", {Rectangle(10.03, 0.02, 20, 12)}),
                                   Feature("B0003", {Rectangle(9.97, 12.01, 20, 30)})});
  ExpectClean(map);
  EXPECT_EQ(FacadesOf(map).size(), 3u + 2u + 2u);
}

// Rows of houses with shared walls, every corner off by up to 2 cm, some wound the wrong way.
std::vector<MapFeature> NoisyRows(int rows, int houses, uint32_t seed) {
  std::mt19937 random(seed);
  const auto noise = [&] { return (static_cast<int>(random() % 401) - 200) * 1e-4; };
  std::vector<MapFeature> features;
  for (int row = 0; row < rows; ++row) {
    for (int i = 0; i < houses; ++i) {
      const double deep = 10 + i % 3;
      Ring ring;
      for (const Eigen::Vector2d& corner : Rectangle(8 * i, 30 * row, 8 * i + 8, 30 * row + deep)) {
        const Eigen::Rotation2Dd turn(0.3);
        ring.push_back(turn * corner + Eigen::Vector2d(noise(), noise()));
      }
      if (random() % 3 == 0) ring = Reversed(ring);
      features.push_back(Feature(fmt::format("B{:05}", features.size() + 1), {ring}));
    }
  }
  return features;
}

TEST(CleanMap, NoisyTerracesBecomeCoverages) {
  for (const uint32_t seed : {1u, 2u, 3u, 4u}) {
    const CleanedMap map = CleanMap(NoisyRows(2, 12, seed));
    ASSERT_EQ(map.footprints.size(), 24u);
    ExpectClean(map);
    // Per row: 12 fronts, 12 backs, 2 ends, and a step at each of the 11 party walls, where one
    // house is deeper than the other.
    const size_t expected = 2 * (12 + 12 + 2 + 11);
    EXPECT_EQ(FacadesOf(map).size(), expected);
  }
}

// Shapes thrown on a heap: everything overlaps everything.
TEST(CleanMap, SettlesHeaps) {
  std::mt19937 random(11);
  for (int trial = 0; trial < 20; ++trial) {
    std::vector<MapFeature> features;
    for (int i = 0; i < 15; ++i) {
      const Ring shape = RandomTown(random(), 1)[0];
      const Eigen::Vector2d shift(random() % 4000 / 100.0, random() % 4000 / 100.0);
      Ring ring;
      for (const Eigen::Vector2d& corner : shape) ring.push_back(corner + shift);
      const bool known = random() % 2 == 0;
      features.push_back(Feature(fmt::format("B{:04}", i), {ring},
                                 known ? std::optional(5.0 + random() % 30) : std::nullopt));
    }
    ExpectClean(CleanMap(features));
  }
}

// Polygons with corners anywhere, most of them crossing themselves, from shed size to block size.
TEST(CleanMap, SettlesTangles) {
  for (const double size : {0.5, 5.0, 50.0, 500.0}) {
    for (uint32_t seed = 0; seed < 15; ++seed) {
      std::mt19937 random(seed);
      const auto within = [&](double reach) { return reach * (random() % 1000) / 1000.0; };
      std::vector<MapFeature> features;
      for (int i = 0; i < 10; ++i) {
        const Eigen::Vector2d corner(within(2 * size), within(2 * size));
        Ring ring(3 + random() % 9);
        for (Eigen::Vector2d& p : ring) p = corner + Eigen::Vector2d(within(size), within(size));
        features.push_back(Feature(fmt::format("B{:04}", i), {ring}));
        if (i % 2 == 0) features.back().height_m = 3 + random() % 40;
        features.back().is_part = i % 3 == 0;
      }
      ExpectClean(CleanMap(features));
    }
  }
}

TEST(CleanMap, HundredThousandCornersTakeSeconds) {
  const auto features = NoisyRows(100, 250, 5);
  const auto start = std::chrono::steady_clock::now();
  const CleanedMap map = CleanMap(features);
  const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  RecordProperty("seconds", fmt::format("{:.2f}", seconds));
  EXPECT_EQ(map.footprints.size(), 25000u);
  EXPECT_LT(seconds, 60);
}

}  // namespace
}  // namespace stucco::plan
