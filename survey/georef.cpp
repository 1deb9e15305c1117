// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/georef.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cassert>
#include <cmath>
#include <numbers>

#include "survey/error.h"
#include "survey/internal/json.h"

namespace stucco {
namespace {

constexpr double kSemiMajor_m = 6378137.0;  // WGS 84
constexpr double kFlattening = 1 / 298.257223563;
constexpr double kEccentricity2 = kFlattening * (2 - kFlattening);
constexpr double kRadPerDeg = std::numbers::pi / 180;

// Radius of curvature in the prime vertical.
double PrimeVertical(double sin_latitude) {
  return kSemiMajor_m / std::sqrt(1 - kEccentricity2 * sin_latitude * sin_latitude);
}

// Earth-centred, Earth-fixed.
Eigen::Vector3d EcefFromGeodetic(double latitude_deg, double longitude_deg, double height_m) {
  const double latitude = latitude_deg * kRadPerDeg;
  const double longitude = longitude_deg * kRadPerDeg;
  const double normal = PrimeVertical(std::sin(latitude));
  return {(normal + height_m) * std::cos(latitude) * std::cos(longitude),
          (normal + height_m) * std::cos(latitude) * std::sin(longitude),
          (normal * (1 - kEccentricity2) + height_m) * std::sin(latitude)};
}

Eigen::Vector3d GeodeticFromEcef(const Eigen::Vector3d& ecef) {
  const double from_axis = std::hypot(ecef.x(), ecef.y());
  double latitude = std::atan2(ecef.z(), from_axis * (1 - kEccentricity2));
  // Each round gains a factor of 1 / kEccentricity2 = 149.
  constexpr int kMaxRounds = 20;
  constexpr double kTolerance_m = 1e-9;
  for (int round = 0; round < kMaxRounds; ++round) {
    const double sine = std::sin(latitude);
    const double next =
        std::atan2(ecef.z() + kEccentricity2 * PrimeVertical(sine) * sine, from_axis);
    const double change_m = std::abs(next - latitude) * kSemiMajor_m;
    latitude = next;
    if (change_m < kTolerance_m) break;
  }
  // This form of the height also holds at the poles.
  const double sine = std::sin(latitude);
  const double height_m = from_axis * std::cos(latitude) + ecef.z() * sine -
                          kSemiMajor_m * std::sqrt(1 - kEccentricity2 * sine * sine);
  return {latitude / kRadPerDeg, std::atan2(ecef.y(), ecef.x()) / kRadPerDeg, height_m};
}

Eigen::Matrix3d EnuFromEcefRotation(const Georef& georef) {
  const double latitude = georef.origin_latitude_deg * kRadPerDeg;
  const double longitude = georef.origin_longitude_deg * kRadPerDeg;
  const double sin_lat = std::sin(latitude), cos_lat = std::cos(latitude);
  const double sin_lon = std::sin(longitude), cos_lon = std::cos(longitude);
  Eigen::Matrix3d rotation;
  rotation << -sin_lon, cos_lon, 0,                     // east
      -sin_lat * cos_lon, -sin_lat * sin_lon, cos_lat,  // north
      cos_lat * cos_lon, cos_lat * sin_lon, sin_lat;    // up
  return rotation;
}

Eigen::Vector3d OriginInEcef(const Georef& georef) {
  return EcefFromGeodetic(georef.origin_latitude_deg, georef.origin_longitude_deg,
                          georef.origin_height_m);
}

std::optional<std::string> FindProblem(const Georef& georef) {
  if (georef.frame != "enu" && georef.frame != "arbitrary") {
    return fmt::format("frame \"{}\" is not \"enu\" or \"arbitrary\"", georef.frame);
  }
  if (!(std::abs(georef.origin_latitude_deg) <= 90)) return "origin_latitude_deg is beyond a pole";
  if (!(std::abs(georef.origin_longitude_deg) <= 360)) return "origin_longitude_deg is over 360";
  constexpr double kUnitTolerance = 1e-6;
  if (georef.up && !(std::abs(georef.up->norm() - 1) < kUnitTolerance)) {
    return "up is not a unit vector";
  }
  if (georef.up_sigma_deg && !(*georef.up_sigma_deg >= 0)) return "up_sigma_deg is negative";
  return std::nullopt;
}

}  // namespace

template <typename Archive, internal::Is<Georef> T>
static void Fields(Archive& archive, T& georef) {
  archive.Required("frame", georef.frame);
  archive.Optional("origin_latitude_deg", georef.origin_latitude_deg);
  archive.Optional("origin_longitude_deg", georef.origin_longitude_deg);
  archive.Optional("origin_height_m", georef.origin_height_m);
  archive.Optional("up", georef.up);
  archive.Optional("up_sigma_deg", georef.up_sigma_deg);
  archive.Required("metric", georef.metric);
  archive.Optional("source", georef.source);
  archive.Optional("on_map", georef.on_map);
}

Georef ReadGeoref(const std::filesystem::path& path) {
  Georef georef = internal::ReadJsonFile<Georef>(path);
  if (const auto problem = FindProblem(georef)) {
    throw Error(ErrorKind::kBadInput, fmt::format("{}: {}", path.string(), *problem));
  }
  return georef;
}

void WriteGeoref(const Georef& georef, const std::filesystem::path& path) {
  assert(!FindProblem(georef));
  internal::WriteJsonFile(georef, path);
}

Eigen::Vector3d EnuFromGeodetic(const Georef& georef, double latitude_deg, double longitude_deg,
                                double height_m) {
  const Eigen::Vector3d ecef = EcefFromGeodetic(latitude_deg, longitude_deg, height_m);
  return EnuFromEcefRotation(georef) * (ecef - OriginInEcef(georef));
}

Eigen::Isometry3d EcefFromEnu(const Georef& georef) {
  assert(georef.frame == "enu");
  Eigen::Isometry3d transform = Eigen::Isometry3d::Identity();
  transform.linear() = EnuFromEcefRotation(georef).transpose();
  transform.translation() = OriginInEcef(georef);
  return transform;
}

Eigen::Vector3d GeodeticFromEnu(const Georef& georef, const Eigen::Vector3d& enu) {
  return GeodeticFromEcef(OriginInEcef(georef) + EnuFromEcefRotation(georef).transpose() * enu);
}

}  // namespace stucco
