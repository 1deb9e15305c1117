// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "plan/path/flights.h"
#include "survey/error.h"
#include "survey/median.h"
#include "tests/plan/made_hovers.h"
#include "tests/site/made_site.h"
#include "tests/survey/stage_support.h"

namespace stucco::plan {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

FlightPlan Fly(const Site& site, std::vector<Hover> hovers, double percent, int threads = 2) {
  return PlanFlights(site, {.use_percent = percent}, std::move(hovers), threads, SilentProgress());
}

TEST(Flights, VisitEveryHoverOnceAlongSafePaths) {
  const Site site = MadeSite(RandomTown(2, 12), {.safe_altitude_m = 40, .d_min_m = 5});
  const Obstacles obstacles(site);
  const auto hovers = DippingHovers(obstacles);
  const FlightPlan plan = Fly(site, hovers, 40);
  ASSERT_EQ(plan.hovers.size(), hovers.size());
  EXPECT_GT(plan.flights.size(), 1U);
  int next = 0;
  double length = 0;
  for (const PlannedFlight& flight : plan.flights) {
    EXPECT_GT(flight.reserve_percent, 0);
    EXPECT_LE(flight.battery_percent + flight.reserve_percent, 40 + 1e-5);
    const PlannedTime& parts = flight.parts;
    EXPECT_NEAR(parts.transfer_min + parts.legs_min + parts.stops_min + parts.photos_min,
                flight.time_min, 1e-9);
    EXPECT_EQ(flight.home_m, site.home);
    const auto& points = flight.waypoints;
    for (const PlannedWaypoint& end : {points.front(), points.back()}) {
      EXPECT_EQ(end.position_m.head<2>(), site.home.head<2>());
      EXPECT_EQ(end.position_m.z(), site.home.z() + site.min_altitude_m);
      EXPECT_EQ(end.hover, -1);
    }
    double sum = 2 * site.min_altitude_m;
    for (size_t k = 1; k < points.size(); ++k) {
      EXPECT_TRUE(obstacles.IsFreeBetween(points[k - 1].position_m, points[k].position_m));
      sum += (points[k].position_m - points[k - 1].position_m).norm();
      if (points[k].hover < 0) continue;
      EXPECT_EQ(points[k].hover, next);
      EXPECT_EQ(points[k].position_m, plan.hovers[next].position);
      ++next;
    }
    EXPECT_NEAR(flight.length_m, sum, 1e-6);
    length += sum;
  }
  EXPECT_EQ(next, static_cast<int>(hovers.size()));
  EXPECT_NEAR(plan.length_m, length, 1e-6);
  const auto key = [](const Hover& h) {
    return std::array{h.position.x(), h.position.y(), h.position.z(), h.shots[0].yaw_rad};
  };
  std::set<std::array<double, 4>> before;
  std::set<std::array<double, 4>> after;
  for (const Hover& hover : hovers) before.insert(key(hover));
  for (const Hover& hover : plan.hovers) after.insert(key(hover));
  EXPECT_EQ(before, after);
}

int FacadesOfTwoFlights(const FlightPlan& plan) {
  std::map<int, std::set<size_t>> flights;
  for (size_t flight = 0; flight < plan.flights.size(); ++flight) {
    for (const PlannedWaypoint& point : plan.flights[flight].waypoints) {
      if (point.hover < 0) continue;
      for (const Shot& shot : plan.hovers[point.hover].shots) {
        for (const Target& target : shot.targets) flights[target.facade].insert(flight);
      }
    }
  }
  return static_cast<int>(
      std::ranges::count_if(flights, [](const auto& facade) { return facade.second.size() > 1; }));
}

// Hovers from the first to the last with a photo of a facade, of those with two or more.
double MedianFacadeSpan(const FlightPlan& plan) {
  std::map<int, std::set<size_t>> hovers;
  for (size_t h = 0; h < plan.hovers.size(); ++h) {
    for (const Shot& shot : plan.hovers[h].shots) {
      for (const Target& target : shot.targets) hovers[target.facade].insert(h);
    }
  }
  std::vector<double> spans;
  for (const auto& [facade, of_facade] : hovers) {
    const size_t span = *of_facade.rbegin() - *of_facade.begin();
    if (span > 0) spans.push_back(static_cast<double>(span));
  }
  return Median(std::move(spans)).value_or(0);
}

TEST(Flights, StartWhereTheWaysAreShortest) {
  Site site = MadeSite(RandomTown(2, 20), {.safe_altitude_m = 40, .d_min_m = 5});
  const auto hovers = DippingHovers(Obstacles(site));
  const FlightPlan from_home = Fly(site, hovers, 40);
  site.take_off = {{site.home.x(), -site.home.y(), 0}, {200, 0, 0}, {0, 0, 0}};
  const FlightPlan from_near = Fly(site, hovers, 40);
  ASSERT_GT(from_home.flights.size(), 2U);
  EXPECT_LE(from_near.flights.size(), from_home.flights.size());
  EXPECT_LT(from_near.battery_percent, from_home.battery_percent);
  std::set<double> homes;
  for (const PlannedFlight& flight : from_near.flights) {
    ASSERT_TRUE(flight.home_m);
    homes.insert(flight.home_m->y());
    EXPECT_EQ(flight.waypoints.front().position_m.head<2>(), flight.home_m->head<2>());
    EXPECT_EQ(flight.waypoints.back().position_m.head<2>(), flight.home_m->head<2>());
  }
  EXPECT_GT(homes.size(), 1U);
}

// A place that is not free is none.
TEST(Flights, DoNotStartFromPlacesThatAreNotFree) {
  Site site = MadeSite({Rectangle(0, 0, 20, 20)});
  site.take_off = {{10, 10, 0}, {25, 10, 0}};
  const FlightPlan plan = Fly(site, {{Vector3d(40, 10, 20), {Shot{}}}}, 80);
  ASSERT_EQ(plan.flights.size(), 1U);
  EXPECT_EQ(plan.flights[0].home_m, site.home);
}

TEST(Flights, RarelyDivideAFacade) {
  const Site site = MadeSite(RandomTown(2, 12), {.safe_altitude_m = 40, .d_min_m = 5});
  const FlightPlan plan = Fly(site, DippingHovers(Obstacles(site)), 40);
  ASSERT_GT(plan.flights.size(), 1U);
  EXPECT_LE(FacadesOfTwoFlights(plan), 2 * static_cast<int>(plan.flights.size()));
}

TEST(Flights, TakeLongerInAStorm) {
  const Site site = MadeSite(RandomTown(2, 6), {.safe_altitude_m = 40, .d_min_m = 5});
  const auto hovers = DippingHovers(Obstacles(site));
  Battery storm;
  storm.pace.wind_m_per_s = 12;
  const FlightPlan calm = PlanFlights(site, {}, hovers, 2, SilentProgress());
  const FlightPlan windy = PlanFlights(site, storm, hovers, 2, SilentProgress());
  EXPECT_GT(windy.time_min, calm.time_min);
  EXPECT_GT(windy.battery_percent, 1.2 * calm.battery_percent);
  EXPECT_GE(windy.flights.size(), calm.flights.size());
}

// w_p pays for it: in a tour without facades, those of one wall lie far apart in time.
TEST(Flights, KeepTheViewsOfAFacadeTogether) {
  const Site site = MadeSite(RandomTown(2, 20), {.safe_altitude_m = 40, .d_min_m = 5});
  const Obstacles obstacles(site);
  const FlightPlan plan = Fly(site, DippingHovers(obstacles), 80);
  const double span = MedianFacadeSpan(plan);
  EXPECT_GT(span, 0);
  EXPECT_LT(span, 0.1 * static_cast<double>(plan.hovers.size()));
}

TEST(Flights, AreTheSameAtAnyNumberOfThreads) {
  const Site site = MadeSite(RandomTown(5, 5), {.safe_altitude_m = 40, .d_min_m = 5});
  const auto hovers = DippingHovers(Obstacles(site));
  const FlightPlan one = Fly(site, hovers, 40, 1);
  const FlightPlan four = Fly(site, hovers, 40, 4);
  ASSERT_GT(one.flights.size(), 1U);
  ASSERT_EQ(one.flights.size(), four.flights.size());
  EXPECT_EQ(one.length_m, four.length_m);
  EXPECT_EQ(one.tour.lower_bound, four.tour.lower_bound);
  for (size_t k = 0; k < one.hovers.size(); ++k) {
    EXPECT_EQ(one.hovers[k].position, four.hovers[k].position);
  }
}

TEST(Flights, OfNothingAndOfOneHover) {
  const Site site = MadeSite({Rectangle(0, 0, 20, 20)});
  const FlightPlan none = Fly(site, {}, 80);
  EXPECT_TRUE(none.flights.empty());
  EXPECT_EQ(none.length_m, 0);
  const FlightPlan one = Fly(site, {{Vector3d(-30, 0, 20), {Shot{}}}}, 80);
  ASSERT_EQ(one.flights.size(), 1U);
  EXPECT_EQ(one.tour.gap(), 0);
  EXPECT_GT(one.length_m, 0);
}

TEST(Flights, SayWhichHoverIsTooFarForABattery) {
  const Site site = MadeSite({Rectangle(0, 0, 20, 20)});
  try {
    Fly(site, {{Vector3d(-30, 0, 20), {Shot{}}}, {Vector3d(9000, 0, 60), {Shot{}}}}, 80);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kBadInput);
    EXPECT_THAT(error.what(), testing::HasSubstr("9000"));
    EXPECT_THAT(error.remedy(), testing::HasSubstr("home"));
  }
}

TEST(Flights, RefuseAHomeThatIsNotFree) {
  Site site = MadeSite({Rectangle(0, 0, 20, 20)}, {.no_fly = {{{Rectangle(100, 0, 150, 50)}}}});
  for (const Vector2d& home : {Vector2d(10, 10), Vector2d(25, 10), Vector2d(120, 20)}) {
    site.home = {home.x(), home.y(), 0};
    try {
      Fly(site, {{Vector3d(-30, 0, 20), {Shot{}}}}, 80);
      FAIL();
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::kBadInput);
      EXPECT_THAT(error.what(), testing::HasSubstr("home"));
    }
  }
}

TEST(Flights, LeaveOutWhatNoFlyPolygonsCutOff) {
  const Polygon ring{{Rectangle(50, 50, 150, 150), Reversed(Rectangle(70, 70, 130, 130))}};
  const Site site = MadeSite({Rectangle(0, 0, 20, 20)}, {.no_fly = {ring}});
  stucco::test::Listener listener;
  const FlightPlan plan =
      PlanFlights(site, {}, {{Vector3d(100, 100, 70), {Shot{}}}, {Vector3d(-30, 0, 20), {Shot{}}}},
                  1, listener);
  EXPECT_EQ(plan.hovers.size(), 1U);
  EXPECT_EQ(listener.warnings.size(), 1U);
}

TEST(Flights, RefuseHoversWhereNothingMayFly) {
  const Site site = MadeSite({Rectangle(0, 0, 20, 20)});
  EXPECT_THROW(Fly(site, {{Vector3d(10, 10, 20), {Shot{}}}}, 80), Error);
}

}  // namespace
}  // namespace stucco::plan
