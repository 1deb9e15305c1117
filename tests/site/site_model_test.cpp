// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "site/site_model.h"

#include <gtest/gtest.h>

#include "tests/site/made_site.h"

namespace stucco {
namespace {

// A house 12 m high around a courtyard.
Site House() {
  return MadeSite(
      std::vector<Polygon>{{{Rectangle(0, 0, 40, 30), Reversed(Rectangle(10, 10, 30, 20))}}},
      {.safe_altitude_m = 22, .heights_m = {12}});
}

TEST(SiteModel, WallsHideWhatIsBehind) {
  const SiteModel model(House());
  EXPECT_TRUE(model.Sees({20, -20, 5}, {20, -1, 5}));
  EXPECT_FALSE(model.Sees({20, -20, 5}, {20, 40, 5}));
  EXPECT_TRUE(model.Sees({20, -20, 12.1}, {20, 40, 12.1}));
}

TEST(SiteModel, PointsOnASurfaceAreSeenFromItsFront) {
  const SiteModel model(House());
  EXPECT_TRUE(model.Sees({20, -20, 5}, {20, 0, 5}));
  EXPECT_TRUE(model.Sees({-70, -20, 20}, {20, 0, 5}));  // 77 degrees from the normal
  EXPECT_FALSE(model.Sees({20, 50, 5}, {20, 0, 5}));
  EXPECT_TRUE(model.Sees({20, 5, 40}, {20, 5, 12}));
  EXPECT_TRUE(model.Sees({20, 5, 40}, {-30, 5, 0}));
}

TEST(SiteModel, CourtyardsAreOpenAbove) {
  const SiteModel model(House());
  EXPECT_TRUE(model.Sees({20, 15, 40}, {20, 15, 0}));
  EXPECT_TRUE(model.Sees({20, 15, 6}, {29.9, 15, 6}));
  EXPECT_FALSE(model.Sees({20, 15, 6}, {45, 15, 6}));
  EXPECT_FALSE(model.Sees({60, 15, 20}, {20, 15, 0}));
}

TEST(SiteModel, PartsAboveTheGroundLeaveAPassageBelow) {
  Site site = House();
  site.footprints[0].z_m.from_m = 6;
  const SiteModel model(site);
  EXPECT_TRUE(model.Sees({5, -20, 3}, {5, 40, 3}));
  EXPECT_FALSE(model.Sees({5, -20, 9}, {5, 40, 9}));
  EXPECT_FALSE(model.Sees({5, 5, 3}, {5, 5, 20}));
}

TEST(SiteModel, HillsHideWhatIsBehind) {
  TerrainGrid hill{.corner = {-100, -100}, .step_m = 10, .columns = 31, .rows = 31, .z_m = {}};
  for (int row = 0; row < 31; ++row) {
    for (int column = 0; column < 31; ++column) hill.z_m.push_back(column == 20 ? 30 : 0);
  }
  const SiteModel model(
      MadeSite(std::vector<Ring>{Rectangle(0, 0, 10, 10)}, {.heights_m = {10}, .terrain = hill}));
  EXPECT_FALSE(model.Sees({80, 50, 10}, {120, 50, 10}));
  EXPECT_TRUE(model.Sees({80, 50, 35}, {120, 50, 31}));
  EXPECT_TRUE(model.Sees({60, 50, 20}, {40, 50, 0}));  // on the ground itself
}

TEST(SiteModel, NothingHidesNothing) {
  const SiteModel model{Site()};
  EXPECT_TRUE(model.Sees({0, 0, 5}, {100, 0, 5}));
  EXPECT_TRUE(model.Sees({0, 0, 5}, {0, 0, 5}));
}

}  // namespace
}  // namespace stucco
