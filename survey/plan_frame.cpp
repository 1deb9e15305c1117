// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/plan_frame.h"

#include <fmt/format.h>

#include <array>
#include <cassert>
#include <cmath>
#include <complex>
#include <numbers>

namespace stucco {
namespace {

constexpr double kSemiMajor_m = 6378137.0;  // WGS 84
constexpr double kFlattening = 1 / 298.257223563;
constexpr double kRadPerDeg = std::numbers::pi / 180;
constexpr double kN = kFlattening / (2 - kFlattening);  // third flattening
constexpr double kN2 = kN * kN;
constexpr double kN3 = kN2 * kN;
constexpr double kN4 = kN2 * kN2;
const double kEccentricity = std::sqrt(kFlattening * (2 - kFlattening));
// Radius of the circle as long as a meridian.
constexpr double kRectifying_m = kSemiMajor_m / (1 + kN) * (1 + kN2 / 4 + kN4 / 64);

// Karney 2011, eq. 35 and 36.
constexpr std::array<double, 4> kForward = {kN / 2 - 2 * kN2 / 3 + 5 * kN3 / 16 + 41 * kN4 / 180,
                                            13 * kN2 / 48 - 3 * kN3 / 5 + 557 * kN4 / 1440,
                                            61 * kN3 / 240 - 103 * kN4 / 140, 49561 * kN4 / 161280};
constexpr std::array<double, 4> kBackward = {kN / 2 - 2 * kN2 / 3 + 37 * kN3 / 96 - kN4 / 360,
                                             kN2 / 48 + kN3 / 15 - 437 * kN4 / 1440,
                                             17 * kN3 / 480 - 37 * kN4 / 840, 4397 * kN4 / 161280};

using Complex = std::complex<double>;

Complex Series(const std::array<double, 4>& coefficients, const Complex& zeta) {
  Complex sum = 0;
  for (size_t j = 0; j < 4; ++j) sum += coefficients[j] * std::sin(2.0 * (j + 1.0) * zeta);
  return sum;
}

// Tangent of the conformal latitude from that of the latitude (Karney 2011, eq. 7).
double ConformalTangent(double tangent) {
  const double secant = std::hypot(1, tangent);
  const double sigma = std::sinh(kEccentricity * std::atanh(kEccentricity * tangent / secant));
  return tangent * std::hypot(1, sigma) - sigma * secant;
}

// Newton's method (Karney 2011, eq. 19 to 21): a few rounds reach the last digit.
double TangentFromConformal(double conformal) {
  constexpr int kRounds = 5;
  const double e2 = kEccentricity * kEccentricity;
  double tangent = conformal / (1 - e2);
  for (int i = 0; i < kRounds; ++i) {
    const double reached = ConformalTangent(tangent);
    tangent += (conformal - reached) / std::hypot(1, reached) * (1 + (1 - e2) * tangent * tangent) /
               ((1 - e2) * std::hypot(1, tangent));
  }
  return tangent;
}

// Distance along the meridian from the equator.
double MeridianNorthing(double latitude_deg) {
  const double conformal = std::atan(ConformalTangent(std::tan(latitude_deg * kRadPerDeg)));
  return kRectifying_m * (conformal + Series(kForward, conformal).real());
}

// Into [-180, 180), so that a site may lie on the date line.
double WrappedDegrees(double degrees) {
  return degrees - 360 * std::floor((degrees + 180) / 360);
}

}  // namespace

Eigen::Vector2d PlanFromGeodetic(const PlanOrigin& origin, const Geodetic& geodetic) {
  const double longitude =
      WrappedDegrees(geodetic.longitude_deg - origin.longitude_deg) * kRadPerDeg;
  const double tangent = ConformalTangent(std::tan(geodetic.latitude_deg * kRadPerDeg));
  const Complex sphere(std::atan2(tangent, std::cos(longitude)),
                       std::asinh(std::sin(longitude) / std::hypot(tangent, std::cos(longitude))));
  const Complex map = kRectifying_m * (sphere + Series(kForward, sphere));
  return {map.imag(), map.real() - MeridianNorthing(origin.latitude_deg)};
}

Geodetic GeodeticFromPlan(const PlanOrigin& origin, const Eigen::Vector2d& position) {
  const Complex map(position.y() + MeridianNorthing(origin.latitude_deg), position.x());
  const Complex zeta = map / kRectifying_m;
  const Complex sphere = zeta - Series(kBackward, zeta);
  const double sinh_east = std::sinh(sphere.imag());
  const double tangent = std::sin(sphere.real()) / std::hypot(sinh_east, std::cos(sphere.real()));
  const double longitude = std::atan2(sinh_east, std::cos(sphere.real())) / kRadPerDeg;
  return {std::atan(TangentFromConformal(tangent)) / kRadPerDeg,
          WrappedDegrees(origin.longitude_deg + longitude)};
}

Eigen::Vector2d EnuFromPlan(const PlanOrigin& origin, const Georef& georef,
                            const Eigen::Vector2d& position) {
  assert(georef.frame == "enu");
  const Geodetic place = GeodeticFromPlan(origin, position);
  return EnuFromGeodetic(georef, place.latitude_deg, place.longitude_deg, georef.origin_height_m)
      .head<2>();
}

std::string FrameCrs(const PlanOrigin& origin) {
  return fmt::format(
      "+proj=tmerc +lat_0={:.5f} +lon_0={:.5f} +k=1 +x_0=0 +y_0=0 +datum=WGS84 "
      "+units=m +no_defs",
      origin.latitude_deg, origin.longitude_deg);
}

PlanOrigin OriginNear(const Geodetic& place) {
  constexpr double kLattice = 1e5;  // per degree
  return {.latitude_deg = std::round(place.latitude_deg * kLattice) / kLattice,
          .longitude_deg = WrappedDegrees(std::round(place.longitude_deg * kLattice) / kLattice),
          .height_m = 0};
}

}  // namespace stucco
