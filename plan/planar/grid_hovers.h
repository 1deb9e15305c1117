// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "plan/camera/hover.h"
#include "plan/camera/preset.h"
#include "site/site.h"

namespace stucco::plan {

struct GridOptions {
  double forward_overlap = 0.8;  // along the flight lines, in [0, 1)
  double side_overlap = 0.8;     // between them
};

// Distances of the grid: what the overlaps leave of a straight-down photo of level ground from the
// safe altitude, the longer side of the photo across the flight lines.
struct GridStep {
  double forward_m = 0;
  double side_m = 0;
};
GridStep StepOf(const Site& site, const CameraPreset& camera, const GridOptions& options);

// Hovers at the ceiling on a regular grid inside Site::area, outside no-fly polygons, with flight
// lines along the main axis of the area, taken to and fro. Each takes five photos: straight down
// and tilted by 45 degrees forward, right, back and left. Throws Error (kBadInput) when the grid
// gets too large to plan.
std::vector<Hover> GridHovers(const Site& site, const CameraPreset& camera,
                              const GridOptions& options);

// How many times finer than the grid hovers above this footprint have to be, as a power of two:
// what rises near to the ceiling is so close below the drone that photos of the grid hardly overlap
// there, or miss it. 1 where they overlap by three fifths, or as much as was asked for, and where
// the map does not tell how high the roof is.
int FinerAbove(const Site& site, const Footprint& footprint, const GridOptions& options);

// Hovers between those of the grid, as many times finer as FinerAbove tells, from where a roof is
// seen at 45 degrees or steeper. Throws Error (kBadInput) as GridHovers does.
std::vector<Hover> HoversAboveHighRoofs(const Site& site, const CameraPreset& camera,
                                        const GridOptions& options);

// The five photos for flight lines with this yaw.
std::vector<Shot> FiveShots(double yaw_rad);

}  // namespace stucco::plan
