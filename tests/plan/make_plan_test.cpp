// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/make_plan.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "site/facades.h"
#include "site/site_of_plan.h"
#include "survey/error.h"
#include "survey/files.h"
#include "survey/geometry2d.h"
#include "tests/site/made_site.h"
#include "tests/survey/temporary_folder.h"

namespace stucco::plan {
namespace {

Plan ObliquePlan(const Site& site) {
  PlanOptions options;
  options.method = "oblique";
  options.forward_overlap = 0.5;
  options.side_overlap = 0.5;
  return MakePlan(site, options, 1, SilentProgress()).plan;
}

TEST(MakePlan, TellsTheSiteThatItWasMadeFor) {
  const Polygon zone{{Rectangle(60, 40, 80, 60), Reversed(Rectangle(66, 46, 74, 54))}};
  const Site site = MadeSite(std::vector<Ring>{Rectangle(0, 0, 20, 12), Rectangle(35, 0, 50, 25)},
                             {.safe_altitude_m = 30, .heights_m = {8, 0}, .no_fly = {zone}});
  const Site told = SiteOfPlan(ObliquePlan(site));
  EXPECT_EQ(told.crs, site.crs);
  EXPECT_EQ(told.home, site.home);
  EXPECT_EQ(told.d_min_m, site.d_min_m);
  ASSERT_EQ(told.no_fly.size(), 1U);
  EXPECT_EQ(told.no_fly[0].rings, zone.rings);
  ASSERT_EQ(told.footprints.size(), site.footprints.size());
  for (size_t i = 0; i < site.footprints.size(); ++i) {
    EXPECT_EQ(told.footprints[i].building, site.footprints[i].building);
    EXPECT_EQ(told.footprints[i].outline.rings, site.footprints[i].outline.rings);
    EXPECT_EQ(told.footprints[i].z_m, site.footprints[i].z_m);
    EXPECT_EQ(told.footprints[i].top_known, site.footprints[i].top_known);
    EXPECT_EQ(told.footprints[i].blocked_to_m, site.footprints[i].blocked_to_m);
    EXPECT_TRUE(told.footprints[i].in_area);
  }
  ASSERT_EQ(told.facades.size(), site.facades.size());
  for (size_t i = 0; i < site.facades.size(); ++i) {
    EXPECT_EQ(told.facades[i].id, site.facades[i].id);
    EXPECT_EQ(told.facades[i].footprint, site.facades[i].footprint);
    EXPECT_EQ(told.facades[i].a, site.facades[i].a);
    EXPECT_EQ(told.facades[i].z_m, site.facades[i].z_m);
  }
}

// Lines of sight and flights know them; the plan carries them on.
TEST(MakePlan, KeepsAwayFromObstacles) {
  Site site = MadeSite(std::vector<Ring>{Rectangle(0, 0, 30, 12), Rectangle(10, -30, 14, -26)},
                       {.safe_altitude_m = 40, .heights_m = {9, 15}});
  Footprint& tree = site.footprints[1];
  tree.building = "O0001";
  tree.is_obstacle = true;
  tree.in_area = false;
  site.facades = MakeFacades(site.footprints);
  const PlanResult result = MakePlan(site, {}, 1, SilentProgress());
  EXPECT_EQ(result.plan.facades.size(), 4u);
  EXPECT_TRUE(result.plan.footprints[1].is_obstacle);
  EXPECT_TRUE(SiteOfPlan(result.plan).footprints[1].is_obstacle);
  size_t low = 0;
  for (const PlannedFlight& flight : result.plan.flights) {
    for (size_t i = 1; i < flight.waypoints.size(); ++i) {
      const Eigen::Vector3d& a = flight.waypoints[i - 1].position_m;
      const Eigen::Vector3d& b = flight.waypoints[i].position_m;
      for (int k = 0; k <= 20; ++k) {
        const Eigen::Vector3d p = a + k / 20.0 * (b - a);
        if (!(p.z() < 25 - 1e-3)) continue;
        ++low;
        EXPECT_GE(Distance(tree.outline, Eigen::Vector2d(p.head<2>())), 10 - 1e-3);
      }
    }
  }
  EXPECT_GT(low, 0u);
  EXPECT_FALSE(result.stats.warnings.empty());
  ASSERT_TRUE(result.stats.flat_within_m);
  EXPECT_NEAR(*result.stats.flat_within_m, 1, 1e-9);
}

TEST(MakePlan, TellsWhatTheFieldSheetNeeds) {
  const Site site = MadeSite({Rectangle(0, 0, 30, 12)}, {.heights_m = {9}});
  PlanOptions options;
  options.date = "2026-10-01";
  const PlanResult result = MakePlan(site, options, 1, SilentProgress());
  ASSERT_EQ(result.days.size(), 1u);
  EXPECT_EQ(result.days[0].date, std::chrono::year(2026) / 10 / 1);
  ASSERT_EQ(result.flights.size(), result.plan.flights.size());
  int photos = 0;
  for (const FlightFacts& flight : result.flights) photos += flight.photos;
  EXPECT_EQ(photos, result.stats.photos);
  EXPECT_GE(result.flights[0].lowest_m, site.min_altitude_m - 1e-6);
  EXPECT_FALSE(result.coverage.places.empty());
  for (const CoveredPlace& place : result.coverage.places) {
    EXPECT_TRUE(place.kind != SurfaceKind::kRoof || place.photos > 0);
  }
  options.date = "someday";
  EXPECT_THROW(MakePlan(site, options, 1, SilentProgress()), Error);
}

// A shaft of 6 m is too narrow to dip into: from above at best, and the plan says so.
TEST(MakePlan, WallsWithoutAStandingPlaceAreListed) {
  const Polygon house{{Rectangle(0, 0, 30, 30), Reversed(Rectangle(12, 12, 18, 18))}};
  const Site site =
      MadeSite(std::vector<Polygon>{house}, {.safe_altitude_m = 30, .heights_m = {9}});
  const PlanResult result = MakePlan(site, {}, 1, SilentProgress());
  ASSERT_EQ(result.plan.facades.size(), 8u);
  for (size_t i = 0; i < 8; ++i) {
    const PlannedFacade& facade = result.plan.facades[i];
    double unseen = 0;
    for (const Interval& part : facade.unobservable_m) unseen += part.length_m();
    EXPECT_NEAR(unseen, i < 4 ? 0 : 6, 0.1) << facade.id;
    EXPECT_FALSE(facade.views.empty()) << facade.id;
  }
}

// By file name. What planning took is no part of the plan.
std::map<std::string, std::string> FilesOf(const Site& site, int threads) {
  PlanResult result = MakePlan(site, {}, threads, SilentProgress());
  result.stats.planning_s = 0;
  const test::TemporaryFolder folder;
  WritePlanFolder(result, {}, folder.path());
  std::map<std::string, std::string> out;
  for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
    out[entry.path().filename().string()] = ReadFile(entry.path());
  }
  return out;
}

TEST(MakePlan, FilesAreTheSameBytesAtAnyNumberOfThreads) {
  const Site site = MadeSite(RandomTown(3, 2), {.safe_altitude_m = 25, .heights_m = {9, 14}});
  const auto one = FilesOf(site, 1), two = FilesOf(site, 2);
  ASSERT_GT(one.size(), 8u);
  ASSERT_EQ(one.size(), two.size());
  for (const auto& [name, bytes] : one) EXPECT_TRUE(two.at(name) == bytes) << name;
}

}  // namespace
}  // namespace stucco::plan
