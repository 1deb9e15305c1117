// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "plan/map/repairs.h"
#include "survey/geometry2d.h"

namespace stucco::plan {

// A building of a map, or a part of one, before cleaning; or an obstacle.
struct MapFeature {
  std::string building;  // B0012; empty for a part that does not say of which building
  bool is_part = false;
  std::vector<Polygon> polygons;  // rings as the map has them; x east, y north
  bool has_open_ring = false;
  std::optional<double> height_m;  // of the top above the ground
  // Of the top above the ground as far as the number of storeys tells it, where `height_m` is not
  // there: good enough for what to photograph, not for where to fly.
  std::optional<double> guessed_height_m = {};
  double min_height_m = 0;  // of the underside above the ground
  // Above 0: `polygons` are points and lines, each a ring, and this much around them is meant.
  double radius_m = 0;
};

struct RawMap {
  std::filesystem::path path;
  std::string crs;  // anything that PROJ reads; empty: the map names none
  std::vector<MapFeature> features;
  RepairLog repairs;
};

}  // namespace stucco::plan
