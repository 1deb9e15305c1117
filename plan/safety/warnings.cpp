// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/safety/warnings.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>

#include "plan/safety/error_budget.h"

namespace stucco::plan {
namespace {

// How a flight counts: a millimetre above a limit is a rounded number.
constexpr double kRounding_m = 0.01;

struct Extremes {
  double highest_m = -std::numeric_limits<double>::infinity();  // above the ground
  double lowest_m = std::numeric_limits<double>::infinity();    // where photos are taken
  double farthest_m = 0;                                        // from the take-off point
  size_t stops = 0;
  size_t low_stops = 0;
  size_t far_stops = 0;
};

// Of stops; of the ways between them the height only, as they lead from stop to stop.
Extremes ExtremesOf(const Site& site, const Plan& plan) {
  Extremes extremes;
  const auto above_ground = [&](const Eigen::Vector3d& p) {
    return p.z() - site.terrain.HeightAt(p.head<2>());
  };
  for (const PlannedFlight& flight : plan.flights) {
    for (const PlannedWaypoint& waypoint : flight.waypoints) {
      extremes.highest_m = std::max(extremes.highest_m, above_ground(waypoint.position_m));
    }
  }
  std::map<int, const PlannedView*> stops;
  for (const PlannedView& view : plan.views) stops.emplace(view.hover, &view);
  extremes.stops = stops.size();
  for (const auto& [hover, view] : stops) {
    const double height = above_ground(view->position_m);
    const Eigen::Vector3d home = plan.HomeOf(view->flight);
    const double away = (view->position_m - home).head<2>().norm();
    extremes.highest_m = std::max(extremes.highest_m, height);
    extremes.lowest_m = std::min(extremes.lowest_m, height);
    extremes.farthest_m = std::max(extremes.farthest_m, away);
    if (height < kTreeHeight_m - kRounding_m) ++extremes.low_stops;
    if (away > kLineOfSight_m + kRounding_m) ++extremes.far_stops;
  }
  return extremes;
}

std::string FlatGround(const ErrorBudget& budget) {
  if (!(budget.flatness_m > 0)) {
    return "no terrain was given (--terrain): the ground is taken to be flat, and the errors of "
           "map "
           "and drone leave nothing for ground that rises above the take-off point";
  }
  return fmt::format(
      "no terrain was given (--terrain): the ground is taken to be flat. It may rise up to {:.1f} "
      "m "
      "above the take-off point; where it rises more, the drone comes too near to ground and roofs",
      budget.flatness_m);
}

void AddBudget(const PlanOptions& options, const ErrorBudget& budget,
               std::vector<std::string>& lines) {
  const double left = std::min(budget.clear_horizontal_m, budget.clear_vertical_m);
  if (left >= kLeastClear_m) return;
  lines.push_back(fmt::format(
      "of the {:g} m kept from buildings (--d-min), errors of map and drone may use up {:.1f} m "
      "horizontally and {:.1f} m vertically: as little as {:.1f} m may be left",
      options.d_min_m, budget.horizontal_m, budget.vertical_m, left));
}

void AddExtremes(const Extremes& extremes, bool has_obstacles, std::vector<std::string>& lines) {
  if (extremes.highest_m > kLegalAltitude_m + kRounding_m) {
    lines.push_back(
        fmt::format("flies up to {:.0f} m above the ground: more than {:g} m need a "
                    "permission in most countries",
                    extremes.highest_m, kLegalAltitude_m));
  }
  if (extremes.low_stops > 0) {
    lines.push_back(fmt::format(
        "{} of {} stops are less than {:g} m above the ground (the lowest {:.1f} m), where trees, "
        "lamps and wires may be: {}",
        extremes.low_stops, extremes.stops, kTreeHeight_m, extremes.lowest_m,
        has_obstacles
            ? "walk the site and look for those that --obstacles does not have"
            : "walk the site, give what is there as --obstacles, or raise --min-altitude"));
  }
  if (extremes.far_stops > 0) {
    lines.push_back(fmt::format(
        "{} of {} stops are more than {:g} m from the take-off point (up to {:.0f} m), too far to "
        "keep the drone in sight: plan parts of the site (--area), each with its own --home",
        extremes.far_stops, extremes.stops, kLineOfSight_m, extremes.farthest_m));
  }
}

}  // namespace

std::vector<std::string> SafetyWarnings(const Site& site, const Plan& plan,
                                        const PlanOptions& options) {
  const ErrorBudget budget = BudgetOf(options);
  std::vector<std::string> lines;
  if (site.terrain.IsFlat()) lines.push_back(FlatGround(budget));
  lines.insert(lines.end(), site.warnings.begin(), site.warnings.end());
  AddBudget(options, budget, lines);
  AddExtremes(ExtremesOf(site, plan), std::ranges::any_of(site.footprints, &Footprint::is_obstacle),
              lines);
  return lines;
}

}  // namespace stucco::plan
