// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/path/flights.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "plan/path/energy.h"
#include "plan/path/facade_cuts.h"
#include "plan/path/flight_work.h"
#include "plan/path/split.h"
#include "survey/error.h"
#include "survey/parallel.h"

namespace stucco::plan {

using Eigen::Vector3d;

namespace {

// A flight that fits exactly still fits when its sum is rounded.
constexpr double kRounding_percent = 1e-6;

// What a facade whose photos are taken in two flights is worth: about twenty seconds.
constexpr double kCutFacade_percent = 1;

// Places to start from that are looked at for a stop, besides home.
constexpr size_t kNearPlaces = 4;

// Where flights may start.
struct Place {
  Vector3d ground;
  Vector3d start;            // straight above, as low as the drone may be
  double transfer_height_m;  // above the ground: nothing of the site reaches it
};

// What all steps need.
struct Task {
  const Site& site;
  const SafeSpace& space;
  Battery battery;
  int threads;
  Progress& progress;

  const PlannedPace& pace() const { return battery.pace; }
  double Percent(const FlightWork& work) const {
    return BatteryPercent(work, battery.pace, battery.scale);
  }
};

Vector3d StartAbove(const Site& site, const Vector3d& ground) {
  return {ground.x(), ground.y(), std::max(ground.z(), site.FloorAt(ground.head<2>()))};
}

// As missions have it: above all that stands anywhere, and above every photo.
Place PlaceAt(const Site& site, const Vector3d& ground, const std::vector<Hover>& hovers) {
  double height_m = site.safe_altitude_m;
  for (const Footprint& footprint : site.footprints) {
    height_m = std::max({height_m, footprint.blocked_to_m - ground.z(),
                         footprint.z_m.to_m + site.d_min_m - ground.z()});
  }
  for (const Hover& hover : hovers) height_m = std::max(height_m, hover.position.z() - ground.z());
  return {ground, StartAbove(site, ground), height_m};
}

// Home first.
std::vector<Place> PlacesOf(const Task& task, const std::vector<Hover>& hovers) {
  std::vector<Place> places{PlaceAt(task.site, task.site.home, hovers)};
  for (const Vector3d& ground : task.site.take_off) {
    const Place place = PlaceAt(task.site, ground, hovers);
    if (task.space.obstacles().IsFree(place.start)) places.push_back(place);
  }
  return places;
}

void ThrowIfCancelled(const Progress& progress) {
  if (progress.Cancelled()) throw Error(ErrorKind::kInterrupted, "interrupted");
}

void CheckHome(const Task& task) {
  if (task.space.obstacles().IsFree(StartAbove(task.site, task.site.home))) return;
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

// Of each hover the places whose ways are looked for: home, which says whether it can be reached at
// all, and those next to it. A flight begins and ends with stops that have a place in common.
std::vector<std::vector<size_t>> NearPlaces(const std::vector<Place>& places,
                                            const std::vector<Hover>& hovers) {
  std::vector<std::vector<size_t>> out;
  out.reserve(hovers.size());
  for (const Hover& hover : hovers) {
    std::vector<std::pair<double, size_t>> by_distance;
    by_distance.reserve(places.size());
    for (size_t p = 1; p < places.size(); ++p) {
      by_distance.emplace_back((places[p].start - hover.position).head<2>().squaredNorm(), p);
    }
    std::ranges::sort(by_distance);
    by_distance.resize(std::min(by_distance.size(), kNearPlaces));
    std::vector<size_t>& near = out.emplace_back(1, 0);
    for (const auto& [distance, place] : by_distance) near.push_back(place);
  }
  return out;
}

// Fills in the ways from a place to a hover and back, in percent of a battery.
void FindWays(const Task& task, const Place& place, const Hover& hover, size_t k, SplitHome& home) {
  auto route = task.space.ShortestRoute(place.start, hover.position);
  if (!route) return;
  home.out[k] = task.Percent(TransferWork(*route, task.pace()) + FirstTiltWork(hover, task.pace()));
  std::reverse(route->points.begin(), route->points.end());
  home.back[k] = task.Percent(TransferWork(*route, task.pace()));
}

// Of places without ways, for so many hovers.
SplitHome HomeAt(const Task& task, const Place& place, size_t hovers) {
  constexpr double kNoWay = std::numeric_limits<double>::infinity();
  SplitHome home;
  home.fixed = task.Percent(
      GroundWork(place.transfer_height_m, place.start.z() - place.ground.z(), task.pace()));
  home.out.assign(hovers, kNoWay);
  home.back.assign(hovers, kNoWay);
  home.reserve.assign(hovers, 0);
  return home;
}

double ReserveAt(const Task& task, const Place& place, const Vector3d& at) {
  return WayHomePercent(
      {(at - place.ground).head<2>().norm(), at.z() - place.ground.z(), place.transfer_height_m},
      task.pace(), task.battery.scale);
}

std::vector<SplitHome> CostsFromHomes(const Task& task, const std::vector<Place>& places,
                                      const std::vector<Hover>& hovers) {
  const std::vector<std::vector<size_t>> near = NearPlaces(places, hovers);
  std::vector<SplitHome> homes;
  homes.reserve(places.size());
  for (const Place& place : places) homes.push_back(HomeAt(task, place, hovers.size()));
  task.progress.Begin("ways from home", hovers.size());
  ParallelFor(hovers.size(), task.threads, [&](size_t k) {
    ThrowIfCancelled(task.progress);
    for (size_t p = 0; p < places.size(); ++p) {
      homes[p].reserve[k] = ReserveAt(task, places[p], hovers[k].position);
    }
    for (const size_t p : near[k]) FindWays(task, places[p], hovers[k], k, homes[p]);
    task.progress.Advance();
  });
  return homes;
}

// Keeps the stops `kept` in this order.
void Reorder(const std::vector<int>& kept, std::vector<SplitHome>& homes) {
  for (SplitHome& home : homes) {
    for (std::vector<double>* costs : {&home.out, &home.back, &home.reserve}) {
      std::vector<double> ordered;
      ordered.reserve(kept.size());
      for (const int k : kept) ordered.push_back((*costs)[k]);
      *costs = std::move(ordered);
    }
  }
}

// Leaves out what cannot be reached from home.
void KeepReachable(const Task& task, std::vector<Hover>& hovers, std::vector<SplitHome>& homes) {
  std::vector<int> reached;
  std::vector<Hover> kept;
  for (size_t k = 0; k < hovers.size(); ++k) {
    if (!std::isfinite(homes.front().out[k])) continue;
    reached.push_back(static_cast<int>(k));
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
  Reorder(reached, homes);
}

double StopPercent(const Task& task, const Hover& hover) {
  return task.Percent(StopWork(hover, task.pace()));
}

// What a flight to this hover alone uses, with the reserve, from where that is least.
double AlonePercent(const std::vector<SplitHome>& homes, size_t hover, double stop) {
  double least = std::numeric_limits<double>::infinity();
  for (const SplitHome& home : homes) {
    least = std::min(least,
                     home.fixed + home.out[hover] + stop + home.back[hover] + home.reserve[hover]);
  }
  return least;
}

void CheckBattery(const Task& task, const std::vector<Hover>& hovers,
                  const std::vector<SplitHome>& homes) {
  for (size_t k = 0; k < hovers.size(); ++k) {
    const double percent = AlonePercent(homes, k, StopPercent(task, hovers[k]));
    if (percent <= task.battery.use_percent) continue;
    const Vector3d& p = hovers[k].position;
    throw Error(
        ErrorKind::kBadInput,
        fmt::format(
            "the photos at ({:.0f}, {:.0f}, {:.0f}) m, {:.0f} m from home, take {:.0f} % of "
            "a battery, the ways there and back and the reserve for wind of {:g} m/s "
            "included, and a flight may use {:.0f} %",
            p.x(), p.y(), p.z(), (p - task.site.home).head<2>().norm(), percent,
            task.pace().wind_m_per_s, task.battery.use_percent),
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

// A tour with all that its flights are made of.
struct Cuttable {
  std::vector<Hover> hovers;
  std::vector<Route> legs;  // to the next, the last to the first
  std::vector<Place> places;
  std::vector<SplitHome> homes;  // by place, for hovers in the tour's order

  const Hover& At(int k) const { return hovers[k % hovers.size()]; }
  const Route& LegFrom(int k) const { return legs[k % legs.size()]; }
};

std::vector<Stretch> Split(const Task& task, const Cuttable& tour) {
  SplitProblem problem;
  problem.homes = tour.homes;
  const std::vector<int> divided = FacadesDivided(tour.hovers, task.site.facades.size());
  for (int k = 0; k < static_cast<int>(tour.hovers.size()); ++k) {
    const FlightWork hop = HopWork(tour.At(k), tour.LegFrom(k), tour.At(k + 1), task.pace());
    problem.stop.push_back(StopPercent(task, tour.At(k)));
    problem.next.push_back(task.Percent(hop));
    problem.cut.push_back(kCutFacade_percent * divided[k]);
  }
  problem.budget = task.battery.use_percent + kRounding_percent;
  return SplitTour(problem);
}

// For the way home from the farthest stop.
double ReserveOf(const SplitHome& home, const Stretch& stretch) {
  double reserve = 0;
  for (int k = 0; k < stretch.count; ++k) {
    reserve = std::max(reserve, home.reserve[(stretch.first + k) % home.reserve.size()]);
  }
  return reserve;
}

Route RouteBetween(const Task& task, const Vector3d& from, const Vector3d& to) {
  const auto route = task.space.ShortestRoute(from, to);
  if (!route) throw Error(ErrorKind::kStageFailed, "a hovering position has no safe way home");
  return *route;
}

// Adds the points of a route after the first.
void Append(const Route& route, PlannedFlight& flight) {
  for (size_t k = 1; k < route.points.size(); ++k)
    flight.waypoints.push_back({route.points[k], -1});
  flight.length_m += route.length_m;
}

// `number`: the index in order of capture of the stretch's first hover.
PlannedFlight MakeFlight(const Task& task, const Cuttable& tour, const Stretch& stretch,
                         int number) {
  const Place& place = tour.places[stretch.home];
  const PlannedPace& pace = task.pace();
  const int last = stretch.first + stretch.count - 1;
  const Route out = RouteBetween(task, place.start, tour.At(stretch.first).position);
  Route back = RouteBetween(task, place.start, tour.At(last).position);
  std::reverse(back.points.begin(), back.points.end());
  const double climb_m = place.start.z() - place.ground.z();
  PlannedFlight flight;
  flight.waypoints.push_back({place.start, -1});
  flight.length_m = 2 * climb_m;
  Append(out, flight);
  FlightWork work = GroundWork(place.transfer_height_m, climb_m, pace) + TransferWork(out, pace) +
                    FirstTiltWork(tour.At(stretch.first), pace);
  for (int k = stretch.first; k <= last; ++k) {
    flight.waypoints.back().hover = number + k - stretch.first;
    work += StopWork(tour.At(k), pace);
    if (k == last) break;
    Append(tour.LegFrom(k), flight);
    work += HopWork(tour.At(k), tour.LegFrom(k), tour.At(k + 1), pace);
  }
  Append(back, flight);
  work += TransferWork(back, pace);
  flight.time_min = work.seconds() / 60;
  flight.battery_percent = task.Percent(work);
  flight.reserve_percent = ReserveOf(tour.homes[stretch.home], stretch);
  flight.parts = TimeParts(work);
  flight.home_m = place.ground;
  return flight;
}

FlightPlan Fly(const Task& task, const Cuttable& tour, const std::vector<Stretch>& stretches,
               const TourReport& report) {
  FlightPlan plan;
  plan.tour = report;
  for (const Stretch& stretch : stretches) {
    PlannedFlight flight = MakeFlight(task, tour, stretch, static_cast<int>(plan.hovers.size()));
    for (int k = 0; k < stretch.count; ++k) plan.hovers.push_back(tour.At(stretch.first + k));
    plan.length_m += flight.length_m;
    plan.time_min += flight.time_min;
    plan.battery_percent += flight.battery_percent;
    plan.flights.push_back(std::move(flight));
  }
  return plan;
}

}  // namespace

FlightPlan PlanFlights(const Site& site, const Battery& battery, std::vector<Hover> hovers,
                       int threads, Progress& progress) {
  const Obstacles obstacles(site);
  const SafeSpace space(obstacles);
  const Task task{site, space, battery, threads, progress};
  CheckHome(task);
  CheckFree(task, hovers);
  Cuttable cuttable;
  cuttable.places = PlacesOf(task, hovers);
  cuttable.homes = CostsFromHomes(task, cuttable.places, hovers);
  KeepReachable(task, hovers, cuttable.homes);
  CheckBattery(task, hovers, cuttable.homes);
  ThrowIfCancelled(progress);
  Tour tour = PlanTour(space, std::move(hovers), threads, progress);
  ThrowIfCancelled(progress);

  cuttable.hovers = std::move(tour.hovers);
  cuttable.legs = FindLegs(task, cuttable.hovers);
  Reorder(tour.given, cuttable.homes);
  CheckBattery(task, cuttable.hovers, cuttable.homes);  // photos are in another order now
  return Fly(task, cuttable, Split(task, cuttable), tour.report);
}

}  // namespace stucco::plan
