// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "plan/safety/warnings.h"
#include "tests/site/made_site.h"

namespace stucco::plan {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

// Stops at these places, each a photo, in one flight from the origin.
Plan Stops(const std::vector<Eigen::Vector3d>& places) {
  Plan plan;
  plan.flights.emplace_back();
  for (size_t i = 0; i < places.size(); ++i) {
    PlannedView& view = plan.views.emplace_back();
    view.position_m = places[i];
    view.hover = static_cast<int>(i);
    plan.flights[0].waypoints.push_back({places[i], static_cast<int>(i)});
  }
  return plan;
}

TerrainGrid Level(double z) {
  return {.corner = {-2000, -2000},
          .step_m = 4000,
          .columns = 2,
          .rows = 2,
          .z_m = std::vector<float>(4, static_cast<float>(z))};
}

Site SiteOn(const TerrainGrid& terrain) {
  return MadeSite(std::vector<Ring>{Rectangle(0, 0, 20, 12)},
                  {.heights_m = {8}, .terrain = terrain});
}

TEST(SafetyWarnings, NoneForAPlanWithinAllLimits) {
  EXPECT_THAT(SafetyWarnings(SiteOn(Level(7)), Stops({{0, 0, 22}, {300, 400, 127}}), {}),
              IsEmpty());
}

TEST(SafetyWarnings, FlatGroundIsSaid) {
  EXPECT_THAT(SafetyWarnings(SiteOn({}), Stops({{0, 0, 20}}), {}),
              ElementsAre(AllOf(HasSubstr("--terrain"), HasSubstr("up to 1.0 m"))));
  PlanOptions options;
  options.min_altitude_m = 3;
  EXPECT_THAT(SafetyWarnings(SiteOn({}), Stops({{0, 0, 20}}), options),
              ElementsAre(HasSubstr("leave nothing")));
}

TEST(SafetyWarnings, WhatTheMapLeavesOpenComesAlong) {
  Site site = SiteOn(Level(0));
  site.warnings = {"of the map"};
  EXPECT_THAT(SafetyWarnings(site, Stops({{0, 0, 20}}), {}), ElementsAre("of the map"));
}

TEST(SafetyWarnings, LittleLeftOfTheDistance) {
  PlanOptions options;
  options.d_min_m = 5;
  EXPECT_THAT(SafetyWarnings(SiteOn(Level(0)), Stops({{0, 0, 20}}), options),
              ElementsAre(HasSubstr("as little as 0.2 m")));
}

// Heights count from the ground below, not from the origin.
TEST(SafetyWarnings, TooHigh) {
  EXPECT_THAT(SafetyWarnings(SiteOn(Level(7)), Stops({{0, 0, 127.5}}), {}),
              ElementsAre(AllOf(HasSubstr("up to 120 m"), HasSubstr("120 m need"))));
  Plan on_the_way = Stops({{0, 0, 50}});
  on_the_way.flights[0].waypoints.push_back({{0, 0, 150}, -1});
  EXPECT_THAT(SafetyWarnings(SiteOn(Level(7)), on_the_way, {}),
              ElementsAre(HasSubstr("up to 143 m")));
}

TEST(SafetyWarnings, AmongTrees) {
  const Plan plan = Stops({{0, 0, 15}, {0, 30, 14.9}, {0, 30, 5}});
  Site site = SiteOn(Level(0));
  EXPECT_THAT(SafetyWarnings(site, plan, {}),
              ElementsAre(AllOf(HasSubstr("2 of 3 stops"), HasSubstr("the lowest 5.0 m"),
                                HasSubstr("give what is there as --obstacles"))));
  site.footprints.back().is_obstacle = true;
  EXPECT_THAT(SafetyWarnings(site, plan, {}), ElementsAre(HasSubstr("does not have")));
}

TEST(SafetyWarnings, OutOfSight) {
  Plan plan = Stops({{0, 0, 20}, {501, 0, 20}, {700, 0, 20}});
  EXPECT_THAT(SafetyWarnings(SiteOn(Level(0)), plan, {}),
              ElementsAre(AllOf(HasSubstr("2 of 3 stops"), HasSubstr("up to 700 m"))));
  plan.home_m = {350, 0, 0};
  EXPECT_THAT(SafetyWarnings(SiteOn(Level(0)), plan, {}), IsEmpty());
}

TEST(SafetyWarnings, APlanWithoutFlightsHasNone) {
  EXPECT_THAT(SafetyWarnings(SiteOn(Level(0)), {}, {}), IsEmpty());
}

}  // namespace
}  // namespace stucco::plan
