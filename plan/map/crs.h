// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <span>
#include <string>
#include <vector>

#include "plan/map/raw_map.h"
#include "survey/plan.h"
#include "survey/plan_frame.h"

namespace stucco::plan {

// The coordinate system that a map is in: its own, or `map_crs` where the map names none (or says
// degrees, as GeoJSON must, and has coordinates that are none). Throws Error where neither fits the
// coordinates.
std::string CrsOfMap(const RawMap& map, const std::string& map_crs);

// Between a coordinate system and WGS 84. Coordinates are east, north (longitude, latitude)
// whatever axes the system lists first. Throws Error (kBadInput) naming `file` when PROJ does not
// know the system; a point that has no place in it becomes NaN.
std::vector<Geodetic> GeodeticFromCrs(const std::string& crs,
                                      std::span<const Eigen::Vector2d> points,
                                      const std::string& file);
std::vector<Eigen::Vector2d> CrsFromGeodetic(const std::string& crs,
                                             std::span<const Geodetic> points,
                                             const std::string& file);

// Replaces the coordinates of the map by those of the plan.
void MoveToPlan(RawMap& map, const std::string& crs, const PlanOrigin& origin);

// The middle of the map.
Geodetic MiddleOf(const RawMap& map, const std::string& crs);

}  // namespace stucco::plan
