// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/path/flight_work.h"

#include <algorithm>
#include <numbers>

namespace stucco::plan {
namespace {

constexpr double kDegrees = 180 / std::numbers::pi;

double Turn(const Shot& from, const Shot& to, const PlannedPace& pace) {
  return TurnSeconds(from.yaw_rad * kDegrees, to.yaw_rad * kDegrees, pace);
}

double Tilt(const Shot& from, const Shot& to, const PlannedPace& pace) {
  return TiltSeconds(from.pitch_rad * kDegrees, to.pitch_rad * kDegrees, pace);
}

double Climbed(const Route& route) {
  double climbed_m = 0;
  for (size_t k = 1; k < route.points.size(); ++k) {
    climbed_m += std::max(0.0, route.points[k].z() - route.points[k - 1].z());
  }
  return climbed_m;
}

// The first leg takes at least `turn_s`.
double RouteSeconds(const Route& route, double turn_s, const PlannedPace& pace) {
  double seconds = 0;
  for (size_t k = 1; k < route.points.size(); ++k) {
    const double leg_s = LegSeconds((route.points[k] - route.points[k - 1]).norm(), pace);
    seconds += k == 1 ? std::max(leg_s, turn_s) : pace.corner_s + leg_s;
  }
  return seconds;
}

}  // namespace

FlightWork StopWork(const Hover& hover, const PlannedPace& pace) {
  FlightWork work;
  work.stops_s = pace.stop_s;
  work.photos_s = static_cast<double>(hover.shots.size()) * PhotoSeconds(pace);
  for (size_t k = 1; k < hover.shots.size(); ++k) {
    work.stops_s += Turn(hover.shots[k - 1], hover.shots[k], pace) +
                    Tilt(hover.shots[k - 1], hover.shots[k], pace);
  }
  return work;
}

FlightWork HopWork(const Hover& from, const Route& route, const Hover& to,
                   const PlannedPace& pace) {
  FlightWork work;
  const Shot& last = from.shots.back();
  const Shot& first = to.shots.front();
  work.legs_s = RouteSeconds(route, Turn(last, first, pace), pace);
  work.stops_s = Tilt(last, first, pace);
  work.climbed_m = Climbed(route);
  return work;
}

FlightWork TransferWork(const Route& route, const PlannedPace& pace) {
  FlightWork work;
  work.transfer_s = RouteSeconds(route, 0, pace);
  work.climbed_m = Climbed(route);
  return work;
}

FlightWork FirstTiltWork(const Hover& first, const PlannedPace& pace) {
  FlightWork work;
  work.stops_s = TiltSeconds(0, first.shots.front().pitch_rad * kDegrees, pace);
  return work;
}

}  // namespace stucco::plan
