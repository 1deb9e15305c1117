// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "plan/mission/route.h"
#include "survey/error.h"
#include "tests/plan/mission_fixture.h"

namespace stucco::plan {
namespace {

TEST(MissionRoute, LeavesOutThePointsOnTheGround) {
  const Plan plan = test::MakePlan();
  const std::vector<MissionRoute> routes = MissionRoutes(plan);
  ASSERT_EQ(routes.size(), 2u);
  ASSERT_EQ(routes[0].stops.size(), 5u);
  EXPECT_EQ(routes[0].stops.front().height_m, 30);
  EXPECT_EQ(routes[0].stops.back().height_m, 30);
  EXPECT_EQ(routes[0].length_m, 231.5);
  EXPECT_EQ(routes[0].time_min, 3.25);
}

TEST(MissionRoute, KeepsPhotosInOrderAndTurnsBeforeItArrives) {
  const Plan plan = test::MakePlan();
  const std::vector<MissionStop> stops = MissionRoutes(plan)[0].stops;
  ASSERT_EQ(stops[1].views.size(), 2u);
  EXPECT_EQ(stops[1].views[0].id, "h000v0");
  EXPECT_EQ(stops[1].views[1].id, "h000v1");
  EXPECT_EQ(stops[0].yaw_deg, 0);
  EXPECT_TRUE(stops[2].views.empty());
  EXPECT_NEAR(stops[2].yaw_deg, -89.875, 1e-9);  // of the photo to come
  EXPECT_NEAR(stops[3].yaw_deg, -89.875, 1e-9);
  EXPECT_EQ(stops[4].yaw_deg, 90);  // of the last photo
}

TEST(MissionRoute, HeightsCountFromHome) {
  const std::vector<MissionRoute> routes = MissionRoutes(test::MakePlan(4));
  EXPECT_EQ(routes[0].stops[1].height_m, 4);
  EXPECT_EQ(routes[0].take_off_height_m, 30);  // above the ground at home: more than blocked_to
}

// Two flights from two places on a slope: each counts from its own.
TEST(MissionRoute, HeightsCountFromTheFlightsOwnHome) {
  Plan plan = test::MakePlan(4);
  plan.flights[1].home_m = Eigen::Vector3d(60, 60, 7);
  const std::vector<MissionRoute> routes = MissionRoutes(plan);
  EXPECT_EQ(routes[0].home_m, plan.home_m);
  EXPECT_EQ(routes[1].home_m, Eigen::Vector3d(60, 60, 7));
  for (const MissionStop& stop : routes[1].stops) {
    EXPECT_EQ(stop.height_m, stop.position_m.z() - 7);
  }
  const auto approach = WithApproach(plan, routes[1], {routes[1].stops[1]});
  EXPECT_EQ(approach.front().height_m, routes[1].return_height_m);
  EXPECT_EQ(approach.front().position_m.z(), 7 + routes[1].return_height_m);
}

TEST(MissionRoute, ReturnsAboveEverything) {
  Plan plan = test::MakePlan();
  plan.footprints[1].blocked_to_m = 44;
  EXPECT_EQ(MissionRoutes(plan)[0].return_height_m, 44);
  plan.flights[1].waypoints[0].position_m.z() = 51;  // a flight over higher ground
  EXPECT_EQ(MissionRoutes(plan)[0].return_height_m, 51);
}

TEST(MissionRoute, MergesPointsThatCoincide) {
  Plan plan = test::MakePlan();
  auto& waypoints = plan.flights[0].waypoints;
  waypoints.insert(waypoints.begin() + 2, {waypoints[2].position_m, -1});
  EXPECT_EQ(MissionRoutes(plan)[0].stops.size(), 5u);
  EXPECT_EQ(MissionRoutes(plan)[0].stops[1].views.size(), 2u);
}

TEST(MissionRoute, GivesALoneStopAPointAboveIt) {
  Plan plan = test::MakePlan();
  plan.flights[0].waypoints = {{plan.home_m, -1}, {{20, -15, 8}, 0}, {plan.home_m, -1}};
  const std::vector<MissionStop> stops = MissionRoutes(plan)[0].stops;
  ASSERT_EQ(stops.size(), 2u);
  EXPECT_EQ(stops[0].position_m, Eigen::Vector3d(20, -15, 30));
  EXPECT_TRUE(stops[0].views.empty());
  EXPECT_EQ(stops[1].views.size(), 2u);
}

TEST(MissionRoute, ApproachesFromAbove) {
  const Plan plan = test::MakePlan();
  const MissionRoute route = MissionRoutes(plan)[0];
  const auto low = WithApproach(plan, route, {route.stops[1], route.stops[2]});
  ASSERT_EQ(low.size(), 4u);
  EXPECT_EQ(low.front().position_m, Eigen::Vector3d(20, -15, 30));
  EXPECT_EQ(low.back().position_m, Eigen::Vector3d(52, -12, 30));
  EXPECT_EQ(low.back().height_m, 30);
  EXPECT_TRUE(low.front().views.empty());
  EXPECT_EQ(WithApproach(plan, route, route.stops).size(), route.stops.size());
  EXPECT_TRUE(WithApproach(plan, route, {}).empty());
}

TEST(MissionRoute, RefusesAPlanWithoutAPath) {
  Plan plan = test::MakePlan();
  plan.flights.clear();
  EXPECT_THROW(MissionRoutes(plan), Error);
  plan = test::MakePlan();
  plan.flights[0].waypoints[2].hover = 77;
  EXPECT_THROW(MissionRoutes(plan), Error);
}

TEST(MissionRoute, AFlightOnTheGroundHasNoStops) {
  Plan plan = test::MakePlan();
  plan.flights[0].waypoints = {{plan.home_m, -1}, {plan.home_m, -1}};
  EXPECT_TRUE(MissionRoutes(plan)[0].stops.empty());
  plan.flights[0].waypoints.clear();
  EXPECT_TRUE(MissionRoutes(plan)[0].stops.empty());
}

TEST(Degrees, AreWrapped) {
  EXPECT_EQ(SignedDegrees(270), -90);
  EXPECT_EQ(SignedDegrees(-180), 180);
  EXPECT_EQ(SignedDegrees(540), 180);
  EXPECT_EQ(SignedDegrees(-725), -5);
  EXPECT_EQ(CompassDegrees(-90), 270);
  EXPECT_EQ(CompassDegrees(360), 0);
}

TEST(NumberedName, NumbersSeveral) {
  EXPECT_EQ(NumberedName("mission", ".kmz", 0, 1), "mission.kmz");
  EXPECT_EQ(NumberedName("mission", ".kmz", 1, 2), "mission_2.kmz");
}

}  // namespace
}  // namespace stucco::plan
