// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulate/render/light.h"

#include <cmath>
#include <numbers>

namespace stucco::simulate {
namespace {

constexpr double kRadians = std::numbers::pi / 180;

// The sun's declination at noon of a day, in radians.
double Declination(int day_of_2026) {
  const double days = day_of_2026 - 1 + 9497;  // since 2000-01-01 12:00 (J2000)
  const double centuries = days / 36525;
  const double mean_longitude = 280.46646 + 36000.76983 * centuries;
  const double anomaly = (357.52911 + 35999.05029 * centuries) * kRadians;
  const double centre = 1.914602 * std::sin(anomaly) + 0.019993 * std::sin(2 * anomaly) +
                        0.000289 * std::sin(3 * anomaly);
  const double longitude = (mean_longitude + centre) * kRadians;
  const double obliquity = (23.439291 - 0.0130042 * centuries) * kRadians;
  return std::asin(std::sin(obliquity) * std::sin(longitude));
}

}  // namespace

Eigen::Vector3d SunDirection(double latitude_deg, int day_of_2026, double solar_hour) {
  const double declination = Declination(day_of_2026);
  const double latitude = latitude_deg * kRadians;
  const double hour_angle = (solar_hour - 12) * 15 * kRadians;  // positive in the afternoon
  return {-std::cos(declination) * std::sin(hour_angle),
          std::cos(latitude) * std::sin(declination) -
              std::sin(latitude) * std::cos(declination) * std::cos(hour_angle),
          std::sin(latitude) * std::sin(declination) +
              std::cos(latitude) * std::cos(declination) * std::cos(hour_angle)};
}

}  // namespace stucco::simulate
