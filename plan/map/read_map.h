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
// the text. Heights are `height_field`, else height, building:height, measuredHeight, hoehe or h,
// to the top of the roof; "12 m", "12,5" and "40 ft" are understood. Where there is none, the
// storeys of walls and roof (building:levels, roof:levels, roof:height) give a guess. Tags as in
// https://wiki.openstreetmap.org/wiki/Simple_3D_Buildings. Throws Error.
RawMap ReadMap(const std::filesystem::path& path, const PlanOptions& options);

// The polygons of a map of areas (areas of interest, no-fly zones), whatever their attributes.
RawMap ReadAreas(const std::filesystem::path& path);

// Points, lines and polygons of a map of obstacles, with the heights that buildings would have.
// Points and lines are as thick as `radius`, half of `diameter_crown` or half of `width` says, else
// 3 m.
RawMap ReadObstacleMap(const std::filesystem::path& path);

}  // namespace stucco::plan
