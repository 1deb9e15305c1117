// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/field/flight_facts.h"

#include <algorithm>
#include <limits>
#include <set>

namespace stucco::plan {
namespace {

// Nearer than this to home, a point without photos is take-off or landing.
constexpr double kAtHome_m = 1;

FlightFacts FactsOfFlight(const Plan& plan, const PlannedFlight& flight,
                          const TerrainGrid& terrain) {
  FlightFacts facts;
  const Eigen::Vector3d home = plan.HomeOf(flight);
  facts.lowest_m = std::numeric_limits<double>::infinity();
  std::set<int> hovers;
  for (const PlannedWaypoint& waypoint : flight.waypoints) {
    const Eigen::Vector3d& at = waypoint.position_m;
    if (waypoint.hover >= 0) hovers.insert(waypoint.hover);
    if (waypoint.hover < 0 && (at - home).norm() < kAtHome_m) continue;
    const double height = at.z() - terrain.HeightAt(at.head<2>());
    facts.lowest_m = std::min(facts.lowest_m, height);
    facts.highest_m = std::max(facts.highest_m, height);
    facts.farthest_m = std::max(facts.farthest_m, (at - home).head<2>().norm());
  }
  facts.lowest_m = std::min(facts.lowest_m, facts.highest_m);
  facts.stops = static_cast<int>(hovers.size());
  return facts;
}

}  // namespace

std::vector<FlightFacts> FactsOf(const Plan& plan, const TerrainGrid& terrain) {
  std::vector<FlightFacts> out;
  for (const PlannedFlight& flight : plan.flights) {
    out.push_back(FactsOfFlight(plan, flight, terrain));
  }
  for (const PlannedView& view : plan.views) {
    if (view.flight >= 0 && static_cast<size_t>(view.flight) < out.size()) {
      ++out[view.flight].photos;
    }
  }
  return out;
}

}  // namespace stucco::plan
