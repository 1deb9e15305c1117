// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "survey/plan.h"

namespace stucco::plan {

// What a flight or a part of it does.
struct FlightWork {
  double transfer_s = 0;  // take-off, the ways from and to home, landing
  double legs_s = 0;      // from stop to stop
  double stops_s = 0;     // coming to rest and speeding up, turns and tilts on the spot
  double photos_s = 0;    // at rest before each photo, and the photo
  double climbed_m = 0;   // all ways up

  double seconds() const { return transfer_s + legs_s + stops_s + photos_s; }
  FlightWork& operator+=(const FlightWork& other);
};
FlightWork operator+(FlightWork one, const FlightWork& other);
PlannedTime TimeParts(const FlightWork& work);

// Along a straight line, slowing down and speeding up apart: the mean over legs that head every way
// in the wind of `pace`. The drone holds its speed over ground until that takes more than its
// highest airspeed.
double LegSeconds(double length_m, const PlannedPace& pace);
// The shorter way round, and a change of the gimbal's pitch.
double TurnSeconds(double from_yaw_deg, double to_yaw_deg, const PlannedPace& pace);
double TiltSeconds(double from_pitch_deg, double to_pitch_deg, const PlannedPace& pace);
// Of one photo, without turns.
double PhotoSeconds(const PlannedPace& pace);

// Take-off to `transfer_height_m`, from there down to the first point, and the landing from there.
FlightWork GroundWork(double transfer_height_m, double first_height_m, const PlannedPace& pace);

// Of one battery; 250 is two and a half. `battery_scale`: batteries of a Mavic 3E that one of this
// drone is worth.
//
// The model: P (f_moving (transfer_s + legs_s) + f_rest (stops_s + photos_s)) plus the lift of what
// is climbed (sinking gives nothing back). P and PlannedPace::stop_s are fitted (least squares of
// relative errors of energy and time, bench/fit_energy.py) to the fourteen flights of a Mavic 3E
// that Xiong et al., "Aerial Path Planning for Urban Geometry and Texture Co-Capture" (2025),
// publish. f says what airspeed adds in the wind of `pace`; docs/planning.md has the formulas, the
// errors and what limits them.
double BatteryPercent(const FlightWork& work, const PlannedPace& pace, double battery_scale);

// Home from a place so far away (on the map) and so high above home, straight against the wind at
// the height of transfer, and down.
struct WayHome {
  double distance_m = 0;
  double height_m = 0;
  double transfer_height_m = 0;
};
double WayHomePercent(const WayHome& way, const PlannedPace& pace, double battery_scale);

}  // namespace stucco::plan
