// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace stucco {

// WGS 84 with a height in metres, of whatever height system it was measured in.
struct PlaceOnEarth {
  double latitude_deg = 0;
  double longitude_deg = 0;
  double height_m = 0;
};

struct PlacesOnEarth {
  std::vector<std::optional<PlaceOnEarth>> places;  // nothing where a point has none in the system
  std::string doubt;                                // about the unit of the heights; empty: none
};

// Places of points given in a coordinate system: an EPSG code, a PROJ text, WKT, or "WGS84 UTM 32N"
// as OpenDroneMap writes it. Coordinates are east, north (longitude, latitude), height, whatever
// axes the system lists first. Heights only change their unit, to metres, where the system has a
// vertical axis that says which: what a geoid model would add depends on the grids that a machine
// happens to have. Throws Error (kBadInput) naming `file` when PROJ does not know the system.
PlacesOnEarth PlacesFromSystem(const std::string& crs, std::span<const Eigen::Vector3d> points,
                               const std::string& file);

}  // namespace stucco
