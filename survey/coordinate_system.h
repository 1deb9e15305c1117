// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "survey/plan_frame.h"

namespace stucco {

// Coordinate systems by what PROJ calls them: "EPSG:25832", WKT, "+proj=...". Names of files and
// addresses of the network are none, since the text may come from a file of anyone's.

// On the earth at all, and not a drawing with axes of its own.
bool IsCrsOnEarth(const std::string& crs);
// Longitude and latitude in degrees.
bool IsCrsGeographic(const std::string& crs);

// Metres in a unit of the coordinates.
struct CrsUnits {
  double horizontal_m = 1;           // 1 for degrees
  std::optional<double> vertical_m;  // nothing where the system has no heights
};
// Requires IsCrsOnEarth(crs).
CrsUnits UnitsOfCrs(const std::string& crs);

// Between a coordinate system and WGS 84. Coordinates are east, north (longitude, latitude)
// whatever axes the system lists first. Throws Error (kBadInput) naming `file` when PROJ does not
// know the system; a point that has no place in it becomes NaN.
std::vector<Geodetic> GeodeticFromCrs(const std::string& crs,
                                      std::span<const Eigen::Vector2d> points,
                                      const std::string& file);
std::vector<Eigen::Vector2d> CrsFromGeodetic(const std::string& crs,
                                             std::span<const Geodetic> points,
                                             const std::string& file);

}  // namespace stucco
