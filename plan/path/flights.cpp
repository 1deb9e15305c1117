// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/path/flights.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "plan/path/energy.h"
#include "plan/path/split.h"
#include "survey/error.h"
#include "survey/median.h"
#include "survey/parallel.h"

namespace stucco::plan {

using Eigen::Vector3d;

namespace {

// A flight that fits exactly still fits when its sum is rounded.
constexpr double kRounding_m = 1e-6;

// What all steps need.
struct Task {
  const Site& site;
  const SafeSpace& space;
  Battery battery;
  int threads;
  Progress& progress;

  Vector3d Start() const {  // above home
    const auto at = site.home.head<2>();
    return {at.x(), at.y(), std::max(site.home.z(), site.FloorAt(at))};
  }
  double Climb() const { return Start().z() - site.home.z(); }
};

void ThrowIfCancelled(const Progress& progress) {
  if (progress.Cancelled()) throw Error(ErrorKind::kInterrupted, "interrupted");
}

void CheckHome(const Task& task) {
  if (task.space.obstacles().IsFree(task.Start())) return;
  const Vector3d& home = task.site.home;
  const double distance = task.space.obstacles().HorizontalDistance(home.head<2>(), home.z());
  throw Error(
      ErrorKind::kBadInput,
      distance < task.site.d_min_m + kSafetyMargin_m
          ? fmt::format("the home point ({:.1f}, {:.1f}) m is {:.1f} m from a building; the drone "
                        "keeps {:.1f} m away",
                        home.x(), home.y(), distance, task.site.d_min_m)
          : fmt::format("the home point ({:.1f}, {:.1f}) m lies in a no-fly polygon", home.x(),
                        home.y()),
      "give a home point in the open");
}

void CheckFree(const Task& task, const std::vector<Hover>& hovers) {
  for (const Hover& hover : hovers) {
    if (task.space.obstacles().IsFree(hover.position)) continue;
    const Vector3d& p = hover.position;
    throw Error(
        ErrorKind::kStageFailed,
        fmt::format("a photo was planned at ({:.2f}, {:.2f}, {:.2f}) m, where the drone may "
                    "not be",
                    p.x(), p.y(), p.z()),
        "report this with the map; another camera or distance may avoid it");
  }
}

// Leaves out what cannot be reached, and returns the distances from home of the others.
std::vector<double> KeepReachable(const Task& task, std::vector<Hover>& hovers) {
  std::vector<double> all(hovers.size());
  task.progress.Begin("distances from home", hovers.size());
  ParallelFor(hovers.size(), task.threads, [&](size_t k) {
    ThrowIfCancelled(task.progress);
    all[k] = task.space.Distance(task.Start(), hovers[k].position);
    task.progress.Advance();
  });
  std::vector<double> distances;
  std::vector<Hover> kept;
  for (size_t k = 0; k < hovers.size(); ++k) {
    if (!std::isfinite(all[k])) continue;
    distances.push_back(all[k]);
    kept.push_back(std::move(hovers[k]));
  }
  if (kept.size() < hovers.size()) {
    task.progress.Warn(
        fmt::format("{} hovering positions are cut off from home by no-fly polygons "
                    "and left out",
                    hovers.size() - kept.size()));
  }
  if (kept.empty() && !hovers.empty()) {
    throw Error(ErrorKind::kBadInput,
                "no photo can be reached from the home point without crossing a no-fly polygon",
                "give another home point (--home), or correct the no-fly polygons");
  }
  hovers = std::move(kept);
  return distances;
}

void CheckBattery(const Task& task, const std::vector<Hover>& hovers,
                  const std::vector<double>& distances) {
  for (size_t k = 0; k < hovers.size(); ++k) {
    const double length = 2 * (distances[k] + task.Climb());
    const double percent = EstimateEffort(length, 1, task.battery.scale).battery_percent;
    if (percent <= task.battery.use_percent) continue;
    const Vector3d& p = hovers[k].position;
    throw Error(
        ErrorKind::kBadInput,
        fmt::format("a photo at ({:.0f}, {:.0f}, {:.0f}) m is {:.0f} m from home: there and "
                    "back takes {:.0f} % of a battery, and a flight may use {:.0f} %",
                    p.x(), p.y(), p.z(), distances[k], percent, task.battery.use_percent),
        "give a home point nearer to the buildings, split the area, or allow more with "
        "--battery-percent");
  }
}

// Paths from each hover to the next, the last to the first.
std::vector<Route> FindLegs(const Task& task, const std::vector<Hover>& hovers) {
  std::vector<Route> legs(hovers.size());
  ParallelFor(legs.size(), task.threads, [&](size_t k) {
    ThrowIfCancelled(task.progress);
    const Vector3d& from = hovers[k].position;
    const Vector3d& to = hovers[(k + 1) % hovers.size()].position;
    const auto route = task.space.ShortestRoute(from, to);
    if (!route) throw Error(ErrorKind::kStageFailed, "two hovering positions have no safe path");
    legs[k] = *route;
  });
  return legs;
}

std::vector<Stretch> Split(const Task& task, const std::vector<double>& home_m,
                           const std::vector<Route>& legs) {
  SplitProblem problem;
  problem.home_m = home_m;
  for (const Route& leg : legs) problem.next_m.push_back(leg.length_m);
  const double per_metre = EstimateEffort(1, 0, task.battery.scale).battery_percent;
  const double per_stop = EstimateEffort(0, 1, task.battery.scale).battery_percent;
  problem.length_budget_m = task.battery.use_percent / per_metre - 2 * task.Climb() + kRounding_m;
  problem.stop_length_m = per_stop / per_metre;
  return SplitTour(problem);
}

// Adds the points of a route after the first.
void Append(const Route& route, std::vector<PlannedWaypoint>& waypoints) {
  for (size_t k = 1; k < route.points.size(); ++k) waypoints.push_back({route.points[k], -1});
}

// `first`: the index in order of capture of the stretch's first hover.
PlannedFlight MakeFlight(const Task& task, const std::vector<Hover>& tour,
                         const std::vector<Route>& legs, const Stretch& stretch, int first) {
  const size_t n = tour.size();
  const size_t last = (static_cast<size_t>(stretch.first) + stretch.count - 1) % n;
  const auto out = task.space.ShortestRoute(task.Start(), tour[stretch.first].position);
  auto back = task.space.ShortestRoute(task.Start(), tour[last].position);
  std::reverse(back->points.begin(), back->points.end());
  PlannedFlight flight;
  flight.waypoints.push_back({task.Start(), -1});
  Append(*out, flight.waypoints);
  flight.length_m = 2 * task.Climb() + out->length_m + back->length_m;
  for (int k = 0; k < stretch.count; ++k) {
    flight.waypoints.back().hover = first + k;
    if (k + 1 == stretch.count) break;
    const Route& leg = legs[(stretch.first + k) % n];
    Append(leg, flight.waypoints);
    flight.length_m += leg.length_m;
  }
  Append(*back, flight.waypoints);
  const Effort effort = EstimateEffort(flight.length_m, stretch.count, task.battery.scale);
  flight.time_min = effort.time_min;
  flight.battery_percent = effort.battery_percent;
  return flight;
}

// When each hover is reached, in minutes of flight from the first take-off.
std::vector<double> TimesOfHovers(const FlightPlan& plan) {
  std::vector<double> times(plan.hovers.size());
  double before = 0;
  for (const PlannedFlight& flight : plan.flights) {
    double length = 0;
    int hovers = 0;
    for (size_t k = 0; k < flight.waypoints.size(); ++k) {
      const PlannedWaypoint& point = flight.waypoints[k];
      if (k > 0) length += (point.position_m - flight.waypoints[k - 1].position_m).norm();
      if (point.hover < 0) continue;
      times[point.hover] = before + EstimateEffort(length, hovers++, 1).time_min;
    }
    before += flight.time_min;
  }
  return times;
}

double MedianFacadeSpan(const FlightPlan& plan, size_t facades) {
  struct Span {
    double from = 0;
    double to = 0;
    int hovers = 0;
  };
  const std::vector<double> times = TimesOfHovers(plan);
  std::vector<Span> spans(facades);
  for (size_t h = 0; h < plan.hovers.size(); ++h) {
    for (const Shot& shot : plan.hovers[h].shots) {
      for (const Target& target : shot.targets) {
        Span& span = spans[target.facade];
        if (span.hovers++ == 0) span.from = times[h];
        span.to = times[h];  // hovers are in order of time
      }
    }
  }
  std::vector<double> lengths;
  for (const Span& span : spans) {
    if (span.to > span.from) lengths.push_back(span.to - span.from);
  }
  return Median(std::move(lengths)).value_or(0);
}

}  // namespace

FlightPlan PlanFlights(const Site& site, const Battery& battery, std::vector<Hover> hovers,
                       int threads, Progress& progress) {
  const Obstacles obstacles(site);
  const SafeSpace space(obstacles);
  const Task task{site, space, battery, threads, progress};
  CheckHome(task);
  CheckFree(task, hovers);
  const std::vector<double> given_home_m = KeepReachable(task, hovers);
  CheckBattery(task, hovers, given_home_m);
  ThrowIfCancelled(progress);
  Tour tour = PlanTour(space, std::move(hovers), threads, progress);
  ThrowIfCancelled(progress);

  const std::vector<Route> legs = FindLegs(task, tour.hovers);
  std::vector<double> home_m;
  for (const int k : tour.given) home_m.push_back(given_home_m[k]);
  FlightPlan plan;
  plan.tour = tour.report;
  int first = 0;
  for (const Stretch& stretch : Split(task, home_m, legs)) {
    plan.flights.push_back(MakeFlight(task, tour.hovers, legs, stretch, first));
    first += stretch.count;
    const PlannedFlight& flight = plan.flights.back();
    plan.length_m += flight.length_m;
    plan.time_min += flight.time_min;
    plan.battery_percent += flight.battery_percent;
    for (int k = 0; k < stretch.count; ++k) {
      plan.hovers.push_back(tour.hovers[(stretch.first + k) % tour.hovers.size()]);
    }
  }
  plan.median_facade_span_min = MedianFacadeSpan(plan, site.facades.size());
  return plan;
}

}  // namespace stucco::plan
