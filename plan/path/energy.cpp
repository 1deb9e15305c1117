// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/path/energy.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace stucco::plan {
namespace {

// Hovering in still air: bench/fit_energy.py.
constexpr double kPercentPerMinute = 3.121;

// Data sheet of the Mavic 3E: in its normal mode 15 m/s at a tilt of 30 degrees; 0.939 kg with RTK;
// a battery of 77 Wh.
constexpr double kTopAirspeed_m_per_s = 15;
constexpr double kTopTilt = 0.5773502691896257;  // tangent of 30 degrees
constexpr double kWeight_N = 0.939 * 9.81;
constexpr double kBattery_J = 77 * 3600;
// From the battery to the air: propellers of this size reach 0.5 to 0.7.
constexpr double kEfficiency = 0.6;
constexpr double kSecondsPerMinute = 60;
// However strong the wind, some way is made: an estimate without end would help nobody.
constexpr double kLeastSpeed_m_per_s = 0.5;

// Power at an airspeed, over that of hovering in still air. Drag grows with the square of airspeed
// and is 0.58 of the weight at the top; thrust carries both, induced power goes with thrust to 3/2
// (momentum theory), and drag takes its own. What translational lift saves is left out.
double PowerFactor(double airspeed_m_per_s) {
  constexpr double kHover_W = kPercentPerMinute / 100 * kBattery_J / kSecondsPerMinute;
  const double drag = kTopTilt * std::pow(airspeed_m_per_s / kTopAirspeed_m_per_s, 2);  // weights
  return std::pow(1 + drag * drag, 0.75) +
         drag * kWeight_N * airspeed_m_per_s / (kEfficiency * kHover_W);
}

struct Motion {
  double ground_m_per_s = 0;
  double air_m_per_s = 0;
};

Motion Against(double speed, double wind) {
  const double ground = std::max(kLeastSpeed_m_per_s, std::min(speed, kTopAirspeed_m_per_s - wind));
  return {ground, ground + wind};
}

// Against the wind, with it, and twice across it.
std::array<Motion, 4> EveryWay(double speed, double wind) {
  const double cross =
      std::min(speed, std::sqrt(std::max(0.0, std::pow(kTopAirspeed_m_per_s, 2) - wind * wind)));
  const Motion across{std::max(kLeastSpeed_m_per_s, cross), std::hypot(cross, wind)};
  return {Against(speed, wind), {speed, std::abs(speed - wind)}, across, across};
}

double MeanSpeed(const PlannedPace& pace) {
  double seconds_per_metre = 0;
  const auto motions = EveryWay(pace.speed_m_per_s, pace.wind_m_per_s);
  for (const Motion& motion : motions) seconds_per_metre += 1 / motion.ground_m_per_s;
  return static_cast<double>(motions.size()) / seconds_per_metre;
}

double MovingFactor(const PlannedPace& pace) {
  double sum = 0;
  const auto motions = EveryWay(pace.speed_m_per_s, pace.wind_m_per_s);
  for (const Motion& motion : motions) sum += PowerFactor(motion.air_m_per_s);
  return sum / static_cast<double>(motions.size());
}

double LiftPercent(double climbed_m) {
  return 100 * kWeight_N * climbed_m / (kEfficiency * kBattery_J);
}

double Percent(double still_air_s, double climbed_m, double battery_scale) {
  return (kPercentPerMinute * still_air_s / kSecondsPerMinute + LiftPercent(climbed_m)) /
         battery_scale;
}

}  // namespace

FlightWork& FlightWork::operator+=(const FlightWork& other) {
  transfer_s += other.transfer_s;
  legs_s += other.legs_s;
  stops_s += other.stops_s;
  photos_s += other.photos_s;
  climbed_m += other.climbed_m;
  return *this;
}

FlightWork operator+(FlightWork one, const FlightWork& other) {
  return one += other;
}

PlannedTime TimeParts(const FlightWork& work) {
  return {work.transfer_s / kSecondsPerMinute, work.legs_s / kSecondsPerMinute,
          work.stops_s / kSecondsPerMinute, work.photos_s / kSecondsPerMinute};
}

double LegSeconds(double length_m, const PlannedPace& pace) {
  return length_m / MeanSpeed(pace);
}

double TurnSeconds(double from_yaw_deg, double to_yaw_deg, const PlannedPace& pace) {
  return std::abs(std::remainder(to_yaw_deg - from_yaw_deg, 360)) / pace.yaw_deg_per_s;
}

double TiltSeconds(double from_pitch_deg, double to_pitch_deg, const PlannedPace& pace) {
  return std::abs(to_pitch_deg - from_pitch_deg) / pace.tilt_deg_per_s;
}

double PhotoSeconds(const PlannedPace& pace) {
  return pace.hold_s + pace.shutter_s;
}

FlightWork GroundWork(double transfer_height_m, double first_height_m, const PlannedPace& pace) {
  FlightWork work;
  work.transfer_s = pace.ground_s + transfer_height_m / pace.climb_m_per_s +
                    std::max(0.0, transfer_height_m - first_height_m) / pace.sink_m_per_s +
                    first_height_m / pace.sink_m_per_s;
  work.climbed_m = transfer_height_m;
  return work;
}

double BatteryPercent(const FlightWork& work, const PlannedPace& pace, double battery_scale) {
  const double still_air_s = MovingFactor(pace) * (work.transfer_s + work.legs_s) +
                             PowerFactor(pace.wind_m_per_s) * (work.stops_s + work.photos_s);
  return Percent(still_air_s, work.climbed_m, battery_scale);
}

double WayHomePercent(const WayHome& way, const PlannedPace& pace, double battery_scale) {
  const Motion motion = Against(pace.transfer_speed_m_per_s, pace.wind_m_per_s);
  const double climb_m = std::max(0.0, way.transfer_height_m - way.height_m);
  const double vertical_s =
      climb_m / pace.climb_m_per_s + way.transfer_height_m / pace.sink_m_per_s;
  const double still_air_s =
      PowerFactor(motion.air_m_per_s) * way.distance_m / motion.ground_m_per_s +
      PowerFactor(pace.wind_m_per_s) * vertical_s;
  return Percent(still_air_s, climb_m, battery_scale);
}

}  // namespace stucco::plan
