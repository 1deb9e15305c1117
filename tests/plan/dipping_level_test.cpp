// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "plan/dipping/candidates.h"
#include "plan/dipping/coverage.h"
#include "plan/dipping/dipping_views.h"
#include "plan/dipping/level.h"
#include "plan/dipping/lift.h"
#include "plan/dipping/wall_view.h"
#include "site/facades.h"
#include "site/ground.h"
#include "tests/plan/made_hovers.h"
#include "tests/site/made_site.h"

namespace stucco::plan {
namespace {

using Eigen::Vector2d;

// A podium of 80 by 80 m and 12 m, with a tower of 16 by 16 m and 40 m in its middle.
Site TowerOnPodium() {
  Site site = MadeSite({Polygon{{Rectangle(0, 0, 80, 80), Reversed(Rectangle(32, 32, 48, 48))}},
                        Polygon{{Rectangle(32, 32, 48, 48)}}},
                       {.safe_altitude_m = 50, .heights_m = {12, 40}});
  for (Footprint& footprint : site.footprints) footprint.building = "B0001";
  site.footprints[0].z_m = {0, 12};
  site.footprints[1].z_m = {0, 40};
  PlaceOnGround(site);
  site.facades = MakeFacades(site.footprints);
  return site;
}

TEST(SplitIntoLevels, OneLevelForAFlatTown) {
  const Site site = MadeSite(RandomTown(1, 10));
  const std::vector<Level> levels = SplitIntoLevels(site);
  ASSERT_EQ(levels.size(), 1u);
  EXPECT_TRUE(levels[0].on_ground);
  EXPECT_EQ(levels[0].facades.size(), site.facades.size());
}

TEST(SplitIntoLevels, WallsAboveARoofAreALevelOfTheirOwn) {
  const Site site = TowerOnPodium();
  const std::vector<Level> levels = SplitIntoLevels(site);
  ASSERT_EQ(levels.size(), 2u);
  EXPECT_EQ(levels[0].facades.size(), 4u);  // of the podium
  EXPECT_EQ(levels[1].facades.size(), 4u);  // of the tower
  EXPECT_FALSE(levels[1].on_ground);
  EXPECT_NEAR(levels[1].bottom_m, 12, 1e-9);
}

TEST(DippingViews, UpperWallsAreCapturedFromAboveTheLowerRoof) {
  const Site site = TowerOnPodium();
  const Obstacles obstacles(site);
  const DippingSetting setting = MakeSetting(site, obstacles, FindCamera("mavic-3e"), 60);
  const DippingReport report = PlanDippingViews(setting, SilentProgress());
  int above_podium = 0;
  for (const Hover& hover : report.hovers) {
    EXPECT_TRUE(obstacles.IsFree(hover.position));
    const bool over_roof = (hover.position.head<2>() - Vector2d(40, 40)).cwiseAbs().maxCoeff() < 40;
    if (!over_roof) continue;
    ++above_podium;
    EXPECT_GE(hover.position.z(), 22);
    for (const Shot& shot : hover.shots) {
      for (const Target& target : shot.targets) {
        EXPECT_NEAR(site.facades[target.facade].z_m.from_m, 12, 1e-9);
      }
    }
  }
  EXPECT_GE(above_podium, 4);
  for (const Intervals& gaps : NotMeant(site, report.hovers)) EXPECT_LT(Length(gaps), 0.05);
}

TEST(DippingViews, FollowTheGroundDownASlope) {
  // The ground falls by 30 m from west to east; two houses of 9 m at its ends.
  TerrainGrid slope{.corner = {-100, -100}, .step_m = 10, .columns = 41, .rows = 21, .z_m = {}};
  for (int row = 0; row < 21; ++row) {
    for (int column = 0; column < 41; ++column) {
      slope.z_m.push_back(static_cast<float>(30 - 30.0 * column / 40));
    }
  }
  const Site site = MadeSite({Rectangle(-60, 0, -48, 10), Rectangle(250, 0, 262, 10)},
                             {.safe_altitude_m = 20, .heights_m = {9, 9}, .terrain = slope});
  const Obstacles obstacles(site);
  const DippingSetting setting = MakeSetting(site, obstacles, FindCamera("mavic-3e"), 60);
  double lowest_west = 1e9, lowest_east = 1e9;
  for (const Hover& hover : PlanDippingViews(setting, SilentProgress()).hovers) {
    EXPECT_TRUE(obstacles.IsFree(hover.position));
    EXPECT_GE(hover.position.z(), site.FloorAt(hover.position.head<2>()) - 1e-9);
    double& lowest = hover.position.x() < 100 ? lowest_west : lowest_east;
    lowest = std::min(lowest, hover.position.z());
  }
  // Well below what would be safe over the western house.
  EXPECT_LT(lowest_east, site.footprints[0].z_m.from_m - 5);
  EXPECT_GT(lowest_west - lowest_east, 15);
}

TEST(Reach, WallsAreCapturedFromNearButNoNearerThanPixelsNeed) {
  const Site site = MadeSite({Rectangle(0, 0, 20, 12)}, {.d_min_m = 5, .heights_m = {9}});
  const Obstacles obstacles(site);
  const auto furthest = [&](double d_max) {
    const DippingSetting setting = MakeSetting(site, obstacles, FindCamera("mavic-3e"), d_max);
    std::vector<Level> levels = SplitIntoLevels(site);
    std::vector<Candidate> candidates = FindCandidates(levels[0], setting);
    LimitReach(setting, levels[0], candidates);
    double distance = 0;
    for (const Candidate& candidate : candidates) {
      for (const SeenFacade& seen : candidate.seen) {
        distance = std::max(distance, DistanceTo(site.facades[seen.facade], candidate.position));
      }
    }
    return distance;
  };
  EXPECT_LT(furthest(30), 1.6 * 5.1 + 0.1);
  EXPECT_GT(furthest(75), 12);
  EXPECT_LT(furthest(75), 15.1);
}

TEST(CoverCounts, CountsViewsOverEveryPiece) {
  const Intervals a{{0, 4}}, b{{2, 6}}, c{{1, 2}, {5, 6}};
  CoverCounts counts({0, 4, 2, 6, 1, 2, 5, 6});
  counts.Add(a);
  counts.Add(b);
  EXPECT_TRUE(counts.IsCovered(Intervals{{0, 6}}, 1));
  EXPECT_TRUE(counts.IsCovered(Intervals{{2, 4}}, 2));
  EXPECT_FALSE(counts.IsCovered(c, 2));
  counts.Add(c);
  EXPECT_TRUE(counts.IsCovered(c, 2));
  counts.Remove(b);
  EXPECT_FALSE(counts.IsCovered(Intervals{{0, 6}}, 1));
  EXPECT_TRUE(counts.IsCovered(Intervals{{0, 4}}, 1));
}

}  // namespace
}  // namespace stucco::plan
