// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "plan/field/flight_facts.h"
#include "tests/plan/mission_fixture.h"

namespace stucco::plan {
namespace {

TEST(FlightFacts, CountWhatIsFlown) {
  const Plan plan = test::MakePlan();
  const auto facts = FactsOf(plan, {});
  ASSERT_EQ(facts.size(), 2u);
  EXPECT_EQ(facts[0].stops, 2);
  EXPECT_EQ(facts[0].photos, 4);
  EXPECT_EQ(facts[0].lowest_m, 8);
  EXPECT_EQ(facts[0].highest_m, 30);
  EXPECT_NEAR(facts[0].farthest_m, std::hypot(85, 52), 1e-9);  // home is at -30, -40
  EXPECT_EQ(facts[1].stops, 1);
  EXPECT_EQ(facts[1].photos, 5);
}

TEST(FlightFacts, HeightsAreAboveTheGroundRightBelow) {
  TerrainGrid terrain;
  terrain.corner = {-100, -100};
  terrain.step_m = 300;
  terrain.columns = terrain.rows = 2;
  terrain.z_m = {3, 3, 3, 3};
  const auto facts = FactsOf(test::MakePlan(), terrain);
  EXPECT_DOUBLE_EQ(facts[0].lowest_m, 5);
  EXPECT_DOUBLE_EQ(facts[0].highest_m, 27);
}

TEST(FlightFacts, FarthestIsFromTheFlightsOwnHome) {
  Plan plan = test::MakePlan();
  plan.flights[0].home_m = Eigen::Vector3d(20, -15, 0);
  EXPECT_LT(FactsOf(plan, {})[0].farthest_m, FactsOf(test::MakePlan(), {})[0].farthest_m);
}

TEST(FlightFacts, OfAFlightThatStaysOnTheGroundAreZeros) {
  Plan plan;
  plan.flights.resize(1);
  plan.flights[0].waypoints = {{plan.home_m, -1}};
  const auto facts = FactsOf(plan, {});
  ASSERT_EQ(facts.size(), 1u);
  EXPECT_EQ(facts[0].lowest_m, 0);
  EXPECT_EQ(facts[0].highest_m, 0);
}

}  // namespace
}  // namespace stucco::plan
