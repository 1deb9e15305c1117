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

// A building of a map, or a part of one, before cleaning.
struct MapFeature {
  std::string building;  // B0012; empty for a part that does not say of which building
  bool is_part = false;
  std::vector<Polygon> polygons;  // rings as the map has them; x east, y north
  bool has_open_ring = false;
  std::optional<double> height_m;  // of the top above the ground
  double min_height_m = 0;         // of the underside above the ground
};

struct RawMap {
  std::filesystem::path path;
  std::string crs;  // anything that PROJ reads; empty: the map names none
  std::vector<MapFeature> features;
  RepairLog repairs;
};

}  // namespace stucco::plan
