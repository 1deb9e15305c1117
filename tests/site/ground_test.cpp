// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "site/ground.h"

#include <gtest/gtest.h>

#include <limits>

#include "tests/site/made_site.h"

namespace stucco {
namespace {

// H 40 m, d_min 10 m. Heights above the ground: see Footprint::z_m.
Site Placed(const Interval& z, bool known) {
  Site site;
  site.safe_altitude_m = 40;
  site.footprints.push_back(
      {.building = "B0001", .outline = {{Rectangle(0, 0, 10, 10)}}, .z_m = z, .top_known = known});
  PlaceOnGround(site);
  return site;
}

TEST(PlaceOnGround, OnlyKnownTopsOpenTheAirAboveThem) {
  const Site known = Placed({0, 12}, true);
  EXPECT_EQ(known.footprints[0].z_m, (Interval{0, 12}));
  EXPECT_EQ(known.footprints[0].blocked_to_m, 22);
  const Site guessed = Placed({0, 12}, false);
  EXPECT_EQ(guessed.footprints[0].z_m, (Interval{0, 12}));  // where its walls are expected to end
  EXPECT_EQ(guessed.footprints[0].blocked_to_m, 40);
  const Site unknown = Placed({0, 0}, false);
  EXPECT_EQ(unknown.footprints[0].z_m, (Interval{0, 30}));
  EXPECT_EQ(unknown.footprints[0].blocked_to_m, 40);
}

TEST(PlaceOnGround, TopsThatAreNotKnownStayBelowTheSafeAltitude) {
  EXPECT_EQ(Placed({0, 80}, false).footprints[0].z_m, (Interval{0, 30}));
  // A part that begins above that has no walls, rather than walls that run backwards.
  EXPECT_EQ(Placed({35, 0}, false).footprints[0].z_m, (Interval{35, 35}));
}

TEST(PlaceOnGround, WhatReachesOverABuildingBlocksIt) {
  const auto blocked = [](double overgrown_to_m) {
    Site site;
    site.safe_altitude_m = 40;
    site.footprints.push_back({.building = "B0001",
                               .outline = {{Rectangle(0, 0, 10, 10)}},
                               .z_m = {0, 12},
                               .top_known = true,
                               .overgrown_to_m = overgrown_to_m});
    PlaceOnGround(site);
    EXPECT_EQ(site.footprints[0].z_m, (Interval{0, 12}));
    return site.footprints[0].blocked_to_m;
  };
  EXPECT_EQ(blocked(25), 35);
  EXPECT_EQ(blocked(5), 22);
  EXPECT_EQ(blocked(std::numeric_limits<double>::infinity()), 40);
}

TEST(PlaceOnGround, GuessedTopsStandOnTheHighestGround) {
  Site site;
  site.safe_altitude_m = 40;
  site.terrain = {.corner = {-50, -50}, .step_m = 10, .columns = 12, .rows = 12, .z_m = {}};
  for (int row = 0; row < 12; ++row) {
    for (int column = 0; column < 12; ++column) {
      site.terrain.z_m.push_back(static_cast<float>(column));  // 1 m in 10 m to the east
    }
  }
  site.footprints.push_back(
      {.building = "B0001", .outline = {{Rectangle(0, 0, 10, 10)}}, .z_m = {0, 12}});
  PlaceOnGround(site);
  EXPECT_NEAR(site.footprints[0].z_m.from_m, 5, 1e-6);
  EXPECT_NEAR(site.footprints[0].z_m.to_m, 18, 1e-6);
  EXPECT_NEAR(site.footprints[0].blocked_to_m, 46, 1e-6);
}

}  // namespace
}  // namespace stucco
