// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "plan/map/raw_map.h"
#include "plan/options/plan_options.h"

namespace stucco::plan {

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
