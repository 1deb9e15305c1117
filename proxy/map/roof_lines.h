// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>
#include <span>
#include <vector>

#include "proxy/facets/arrangement.h"
#include "proxy/facets/raster.h"
#include "proxy/map/extrude_cells.h"
#include "proxy/map/fitted_building.h"
#include "proxy/map/roof_planes.h"

namespace stucco {

// What LabelRoof is asked for.
struct RoofTask {
  const FittedBuilding& building;
  const RoofEvidence& evidence;
  std::span<const int> planes;
  const Tolerances& tolerances;
};

// A metre more than the building on all sides.
Eigen::AlignedBox2d BoxAround(const MapBuilding& building);

// The ground plan of a footprint in small cells: where each roof has its samples.
struct CoverOfRoofs {
  PlaneRaster raster;                      // its frame is that of the ground plan
  std::vector<std::vector<float>> to_hit;  // of each roof: metres to its nearest sample
  std::vector<float> to_open;              // metres to where the ground lies open; empty: nowhere
};

CoverOfRoofs CoverOf(const RoofTask& task);

// The lines of a footprint's edges, the longest first.
std::vector<CutLine> EdgeLines(const MapBuilding& building, const Eigen::AlignedBox2d& box);

// The lines in which roofs meet, where both have samples near them.
std::vector<CutLine> CreasesOf(const CoverOfRoofs& cover, const std::vector<RoofPlane>& roofs,
                               const Tolerances& tolerances);

// Lines of edges, of creases, then of upright planes and of straight borders.
std::vector<CutLine> LinesOf(const RoofTask& task, const CoverOfRoofs& cover,
                             const std::vector<RoofPlane>& roofs);

// The same edges, and what is no crease of those lines, with the creases of other roofs.
std::vector<CutLine> WithCreases(const RoofTask& task, const std::vector<CutLine>& lines,
                                 const std::vector<CutLine>& creases);

}  // namespace stucco
