// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/mission/route.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "survey/error.h"

namespace stucco::plan {
namespace {

// Nearer than this to home, points at the ends of a flight are take-off and landing.
constexpr double kAtHome = 1;
// Closer points are one: autopilots refuse legs without length.
constexpr double kSamePoint = 0.05;

// Take-off and landing are the autopilot's own business: a waypoint on the ground is none.
bool IsOnTheGround(const Eigen::Vector3d& home, const PlannedWaypoint& waypoint) {
  return waypoint.hover < 0 && (waypoint.position_m - home).norm() < kAtHome;
}

std::vector<PlannedWaypoint> InTheAir(const Eigen::Vector3d& home,
                                      std::vector<PlannedWaypoint> waypoints) {
  const auto flies = [&](const PlannedWaypoint& waypoint) {
    return !IsOnTheGround(home, waypoint);
  };
  const auto first = std::ranges::find_if(waypoints, flies);
  const auto last = std::find_if(waypoints.rbegin(), waypoints.rend(), flies).base();
  if (first >= last) return {};
  return {first, last};
}

using ViewsOfHover = std::map<int, std::vector<PlannedView>>;

ViewsOfHover ByHover(const Plan& plan) {
  ViewsOfHover hovers;
  for (const PlannedView& view : plan.views) hovers[view.hover].push_back(view);
  for (auto& [hover, views] : hovers) {
    std::ranges::sort(views, {}, &PlannedView::order);
  }
  return hovers;
}

void Append(const Plan& plan, const Eigen::Vector3d& position, std::vector<PlannedView> views,
            MissionRoute& route) {
  std::vector<MissionStop>& stops = route.stops;
  if (!stops.empty() && (stops.back().position_m - position).norm() < kSamePoint) {
    std::ranges::move(views, std::back_inserter(stops.back().views));
    return;
  }
  stops.push_back({.position_m = position,
                   .geodetic = GeodeticFromPlan(plan.origin, position.head<2>()),
                   .height_m = position.z() - route.home_m.z(),
                   .views = std::move(views)});
}

// The drone turns while it flies: it arrives as the photo wants it.
void SetYaws(std::vector<MissionStop>& stops) {
  double yaw = 0;
  for (const MissionStop& stop : stops) {
    if (!stop.views.empty()) yaw = stop.views.back().yaw_deg;  // after the last photo it stays
  }
  for (auto stop = stops.rbegin(); stop != stops.rend(); ++stop) {
    if (!stop->views.empty()) yaw = stop->views.front().yaw_deg;
    stop->yaw_deg = SignedDegrees(yaw);
  }
}

// Above home, over everything that stands anywhere on the site.
double ReturnHeight(const Plan& plan, const Eigen::Vector3d& home) {
  double highest = plan.safe_altitude_m;
  for (const PlannedFootprint& footprint : plan.footprints) {
    highest = std::max(
        {highest, footprint.blocked_to_m - home.z(), footprint.z_m.to_m + plan.d_min_m - home.z()});
  }
  for (const PlannedFlight& flight : plan.flights) {
    for (const PlannedWaypoint& waypoint : flight.waypoints) {
      highest = std::max(highest, waypoint.position_m.z() - home.z());
    }
  }
  return highest;
}

// Nearer than this to the wished height is there already.
constexpr double kSameHeight = 1;

MissionStop Above(const Plan& plan, const MissionStop& stop, double by_m) {
  MissionStop above = stop;
  above.views.clear();
  above.position_m.z() += by_m;
  above.geodetic = GeodeticFromPlan(plan.origin, above.position_m.head<2>());
  above.height_m += by_m;
  return above;
}

// Autopilots want two points at least: the second is straight above the only one.
void AddPointAbove(const Plan& plan, double height_m, std::vector<MissionStop>& stops) {
  if (stops.size() != 1) return;
  const double by_m = std::max(height_m - stops.front().height_m, kSameHeight);
  stops.insert(stops.begin(), Above(plan, stops.front(), by_m));
}

MissionRoute MissionRouteOf(const Plan& plan, const PlannedFlight& flight,
                            const ViewsOfHover& hovers) {
  MissionRoute route;
  route.home_m = plan.HomeOf(flight);
  route.length_m = flight.length_m;
  route.time_min = flight.time_min;
  for (const PlannedWaypoint& waypoint : InTheAir(route.home_m, flight.waypoints)) {
    const auto found = hovers.find(waypoint.hover);
    if (waypoint.hover >= 0 && found == hovers.end()) {
      throw Error(ErrorKind::kStageFailed,
                  fmt::format("a flight stops at hover {}, which has no views", waypoint.hover));
    }
    const bool passes = waypoint.hover < 0;
    Append(plan, waypoint.position_m, passes ? std::vector<PlannedView>() : found->second, route);
  }
  SetYaws(route.stops);
  return route;
}

}  // namespace

double CompassDegrees(double degrees) {
  const double turned = std::fmod(degrees, 360);
  return turned < 0 ? turned + 360 : turned;
}

double SignedDegrees(double degrees) {
  const double compass = CompassDegrees(degrees);
  return compass > 180 ? compass - 360 : compass;
}

std::string NumberedName(const std::string& stem, const std::string& extension, size_t index,
                         size_t count) {
  if (count == 1) return stem + extension;
  return fmt::format("{}_{}{}", stem, index + 1, extension);
}

std::vector<MissionStop> WithApproach(const Plan& plan, const MissionRoute& route,
                                      std::vector<MissionStop> stops) {
  if (stops.empty()) return stops;
  const double begin_m = route.return_height_m - stops.front().height_m;
  const double end_m = route.return_height_m - stops.back().height_m;
  if (end_m > kSameHeight) stops.push_back(Above(plan, stops.back(), end_m));
  if (begin_m > kSameHeight) stops.insert(stops.begin(), Above(plan, stops.front(), begin_m));
  return stops;
}

std::vector<MissionRoute> MissionRoutes(const Plan& plan) {
  if (plan.flights.empty()) {
    throw Error(ErrorKind::kStageFailed, "the plan has no flights to write mission files of",
                "plan the path first: the views alone do not say how to get there");
  }
  const ViewsOfHover hovers = ByHover(plan);
  std::vector<MissionRoute> routes;
  for (const PlannedFlight& flight : plan.flights) {
    MissionRoute& route = routes.emplace_back(MissionRouteOf(plan, flight, hovers));
    const double return_height = ReturnHeight(plan, route.home_m);
    AddPointAbove(plan, return_height, route.stops);
    route.return_height_m = return_height;
    // The way to the first point is the drone's own: it goes above everything.
    route.take_off_height_m = return_height;
  }
  return routes;
}

}  // namespace stucco::plan
