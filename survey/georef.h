// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>
#include <filesystem>
#include <optional>
#include <string>

namespace stucco {

// Georef::source where ground control points hold the frame.
inline constexpr char kGroundControlSource[] = "gcp";

// What the world frame of a survey is (calib/georef.json).
struct Georef {
  // "enu": metres east, north, up of the origin. "arbitrary": scale and directions are free.
  std::string frame = "arbitrary";
  double origin_latitude_deg = 0;  // WGS 84; only for "enu"
  double origin_longitude_deg = 0;
  double origin_height_m = 0;
  // Unit vector away from the ground, when calibration knows it (GPS or gimbal).
  std::optional<Eigen::Vector3d> up;
  // One standard deviation of its direction, where measured.
  std::optional<double> up_sigma_deg = std::nullopt;
  bool metric = false;  // lengths are metres
  // "gcp", "rtk", "gps", "plan", "gimbal", "none"; "file": an imported model said so itself.
  std::string source;
  bool on_map = false;  // moved, level, onto the walls of the plan's map
};

// calib/georef.json. Throws Error (kBadInput).
Georef ReadGeoref(const std::filesystem::path& path);
void WriteGeoref(const Georef& georef, const std::filesystem::path& path);

// WGS 84 geodetic to the local tangent frame of the georef and back (Farrell & Barth 1999, eq. 2.7
// to 2.10; the backward step iterates to below 1e-9 m).
Eigen::Vector3d EnuFromGeodetic(const Georef& georef, double latitude_deg, double longitude_deg,
                                double height_m);
Eigen::Vector3d GeodeticFromEnu(const Georef& georef, const Eigen::Vector3d& enu);

// From that frame to geocentric coordinates (EPSG:4978), metres. Requires frame "enu".
Eigen::Isometry3d EcefFromEnu(const Georef& georef);

}  // namespace stucco
