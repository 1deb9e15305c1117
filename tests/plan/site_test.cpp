// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/site.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "plan/map/ground.h"
#include "survey/geometry2d.h"
#include "tests/plan/made_site.h"

namespace stucco::plan {
namespace {

// Rises 20 m towards the east over 400 m, with a bump.
Terrain Slope() {
  Terrain terrain{.corner = {-200, -200}, .step_m = 5, .columns = 81, .rows = 81, .z_m = {}};
  for (int row = 0; row < 81; ++row) {
    for (int column = 0; column < 81; ++column) {
      const double bump = 8 * std::exp(-std::pow(row - 40, 2) / 20 - std::pow(column - 60, 2) / 20);
      terrain.z_m.push_back(static_cast<float>(column * 0.25 + bump));
    }
  }
  return terrain;
}

TEST(Site, CeilingOfFlatGroundIsTheSafeAltitude) {
  const Site site = MadeSite(std::vector<Ring>{Rectangle(0, 0, 20, 10)},
                             {.safe_altitude_m = 45, .heights_m = {30}});
  EXPECT_EQ(site.CeilingAt({10, 5}), 45);
  EXPECT_EQ(site.CeilingAt({1e5, 5}), 45);
  EXPECT_EQ(site.CeilingBetween({-50, 0}, {50, 0}), 45);
  EXPECT_EQ(site.FloorAt({10, 5}), 5);
}

TEST(Site, HeightsDecideWhatIsBlocked) {
  const Site site = MadeSite(std::vector<Ring>{Rectangle(0, 0, 20, 10), Rectangle(50, 0, 70, 10)},
                             {.safe_altitude_m = 45, .d_min_m = 8, .heights_m = {30, 0}});
  EXPECT_TRUE(site.footprints[0].top_known);
  EXPECT_EQ(site.footprints[0].z_m, (Interval{0, 30}));
  EXPECT_EQ(site.footprints[0].blocked_to_m, 38);
  EXPECT_FALSE(site.footprints[1].top_known);
  EXPECT_EQ(site.footprints[1].z_m, (Interval{0, 37}));
  EXPECT_EQ(site.footprints[1].blocked_to_m, 45);
}

TEST(Site, BuildingsStandOnTheLowestGroundUnderThem) {
  const Site site = MadeSite(std::vector<Ring>{Rectangle(-100, -50, -40, -30)},
                             {.heights_m = {12}, .terrain = Slope()});
  EXPECT_NEAR(site.footprints[0].z_m.from_m, 5, 1e-5);
  EXPECT_NEAR(site.footprints[0].z_m.to_m, 17, 1e-5);
  EXPECT_NEAR(site.footprints[0].blocked_to_m, 27, 1e-5);
}

TEST(Site, CeilingStaysAboveGroundNearbyAndBlockedBuildings) {
  std::vector<double> heights(60);
  for (size_t i = 0; i < heights.size(); i += 2) heights[i] = 20 + i / 4.0;
  const Site site = MadeSite(RandomTown(4, 60),
                             {.safe_altitude_m = 50, .heights_m = heights, .terrain = Slope()});
  std::mt19937 random(1);
  for (int i = 0; i < 2000; ++i) {
    const Eigen::Vector2d p(-260 + (random() % 5200) / 10.0, -260 + (random() % 5200) / 10.0);
    const double ceiling = site.CeilingAt(p);
    EXPECT_GE(ceiling, site.terrain.HighestAround(p, 30) + 50);
    // Not higher than the ground within 45 m (30 m and the coarseness of the grid) asks for, unless
    // a building without a height does.
    double bound = site.terrain.HighestAround(p, 60) + 50;
    for (const Footprint& footprint : site.footprints) {
      const double distance = Distance(footprint.outline, p);
      if (distance <= site.d_min_m) {
        EXPECT_GE(ceiling, footprint.blocked_to_m);
      }
      if (distance <= site.d_min_m + 20) bound = std::max(bound, footprint.blocked_to_m);
    }
    EXPECT_LE(ceiling, bound + 1e-3);
  }
}

TEST(Site, CeilingOfALongUnknownBuildingOnASlopeHoldsAtItsLowEnd) {
  const Site site = MadeSite(std::vector<Ring>{Rectangle(-150, -50, 150, -30)},
                             {.safe_altitude_m = 50, .terrain = Slope()});
  EXPECT_NEAR(site.footprints[0].blocked_to_m, 17.5 + 50, 0.2);
  EXPECT_GE(site.CeilingAt({-155, -40}), site.footprints[0].blocked_to_m);
  EXPECT_LT(site.CeilingAt({-190, -40}), site.footprints[0].blocked_to_m - 10);
}

TEST(Site, CeilingBetweenIsTheHighestOnTheWay) {
  const Site site = MadeSite(RandomTown(4, 20), {.safe_altitude_m = 50, .terrain = Slope()});
  const Eigen::Vector2d p(-100, 20);
  const Eigen::Vector2d q(150, -10);
  double highest = 0;
  for (int k = 0; k <= 1000; ++k) {
    highest = std::max(highest, site.CeilingAt(p + k / 1000.0 * (q - p)));
  }
  EXPECT_GE(site.CeilingBetween(p, q), highest - 1e-9);
  EXPECT_NEAR(site.CeilingBetween(p, q), highest, 0.1);
}

TEST(RandomTown, IsTheSameForASeedAndBuildingsKeepApart) {
  const std::vector<Ring> town = RandomTown(7, 50);
  ASSERT_EQ(town.size(), 50u);
  EXPECT_EQ(town, RandomTown(7, 50));
  EXPECT_NE(town, RandomTown(8, 50));
  double built = 0;
  for (size_t i = 0; i < town.size(); ++i) {
    EXPECT_GT(SignedArea(town[i]), 20);
    built += SignedArea(town[i]);
    for (size_t k = 0; k < town.size(); ++k) {
      if (k == i) continue;
      for (const Eigen::Vector2d& corner : town[k]) {
        EXPECT_GT(Distance({{town[i]}}, corner), 0.1);
      }
    }
  }
  EXPECT_GT(built / 50, 100);
}

}  // namespace
}  // namespace stucco::plan
