// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>
#include <filesystem>

#include "plan/map/repairs.h"
#include "site/terrain_grid.h"
#include "survey/plan.h"

namespace stucco::plan {

struct ReadTerrain {
  TerrainGrid terrain;         // nowhere below the raster; z relative to `origin_height_m`
  TerrainGrid ground;          // the raster interpolated, which cuts peaks between samples
  double origin_height_m = 0;  // of the ground at the origin, in the height system of the file
  RepairLog repairs;
};

// The ground within `bounds` (in the frame of the plan) from a GeoTIFF or another raster of heights
// in any coordinate system. Sampled as finely as the raster, but not below 2 m; gaps are filled
// from around them. Both grids interpolate between their samples; on even slopes they are the same.
// Throws Error where the raster does not cover the bounds.
ReadTerrain ReadDem(const std::filesystem::path& path, const PlanOrigin& origin,
                    const Eigen::AlignedBox2d& bounds);

}  // namespace stucco::plan
