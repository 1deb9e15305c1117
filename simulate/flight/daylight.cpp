// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulate/flight/daylight.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace stucco::simulate {
namespace {

constexpr double kDegrees = 180 / std::numbers::pi;

// Air before the sun, times that of a sun overhead.
double AirMass(double elevation_deg) {
  const double e = std::max(elevation_deg, 0.0);
  return 1 / (std::sin(e / kDegrees) + 0.50572 * std::pow(e + 6.07995, -1.6364));
}

}  // namespace

double SunElevation_deg(double latitude_deg, int day_of_year, double solar_hour) {
  const Eigen::Vector3d sun = SunDirection(latitude_deg, day_of_year, solar_hour);
  return std::asin(std::clamp(sun.z(), -1.0, 1.0)) * kDegrees;
}

Light DaylightAt(const FlightOptions& options, double latitude_deg, int day_of_year,
                 double solar_hour) {
  Light light;
  light.haze_m = options.haze_m;
  light.to_sun = SunDirection(latitude_deg, day_of_year, solar_hour);
  const double elevation_deg = SunElevation_deg(latitude_deg, day_of_year, solar_hour);
  const float high = static_cast<float>(std::sqrt(std::max(0.0, light.to_sun.z()) * std::sqrt(2)));
  light.sky *= high;
  if (!options.sun) {
    light.sun.setZero();
    light.sky = Eigen::Vector3f(0.98f, 1.0f, 1.04f) * high;
    return light;
  }
  // Of the clear atmosphere at 610, 550 and 465 nm, molecules and a little dust.
  const Eigen::Array3d depth(0.10, 0.14, 0.23);
  const double more_air = AirMass(elevation_deg) - AirMass(45);
  light.sun.array() *= (-depth * more_air).exp().cast<float>();
  return light;
}

Eigen::Vector3d NeutralGains(const Light& light) {
  // What is seen is turned half towards the sun, on the average.
  constexpr float kTowardsSun = 0.5f;
  const Eigen::Vector3d seen = (kTowardsSun * light.sun + light.sky).cast<double>();
  constexpr double kShare = 0.7;
  if (!(seen.minCoeff() > 0)) return Eigen::Vector3d::Ones();
  return (seen.y() / seen.array()).pow(kShare);
}

}  // namespace stucco::simulate
