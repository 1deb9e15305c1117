// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "plan/map/repairs.h"
#include "plan/options.h"
#include "site/site.h"

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

// Buildings of a map: GeoJSON, Shapefile, GeoPackage, OSM XML or PBF (`building` and
// `building:part`), CityJSON 1.0 to 2.0, and whatever else GDAL reads polygons from.
//
// A layer with "building" in its name goes before others; `map_layer` names another. Ids are the
// map's own (`id_field`, else id, osm_id, uid ... fid): numbers become B0012, other texts "B" and
// the text. Heights are `height_field`, else height, building:height, measuredHeight, hoehe, h, or
// building:levels of 3 m each; "12 m", "12,5" and "40 ft" are understood. Throws Error.
RawMap ReadMap(const std::filesystem::path& path, const PlanOptions& options);

// The polygons of a map of areas (areas of interest, no-fly zones), whatever their attributes.
RawMap ReadAreas(const std::filesystem::path& path);

}  // namespace stucco::plan
