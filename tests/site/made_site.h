// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "site/site.h"

namespace stucco {

struct MadeSiteOptions {
  double safe_altitude_m = 60;
  double d_min_m = 10;
  double min_altitude_m = 5;
  double margin_m = 60;                // of the area around the bounding box of the footprints
  std::vector<double> heights_m = {};  // above the ground, by footprint; empty or 0: unknown
  std::vector<Polygon> no_fly = {};
  TerrainGrid terrain = {};
};

// A site as reading a map makes it, without the map: buildings B0001, B0002 ... of one footprint
// each, with facades, ceiling, area and a home south of the buildings.
Site MadeSite(const std::vector<Polygon>& footprints, const MadeSiteOptions& options = {});
Site MadeSite(const std::vector<Ring>& footprints, const MadeSiteOptions& options = {});

// A house of 20 m by 10 m and 9 m height alone; its south wall is facade 0.
Site LoneHouse();

Ring Rectangle(double x0, double y0, double x1, double y1);  // counter-clockwise
Ring Reversed(Ring ring);                                    // as a courtyard

// Rectangles, L- and U-shapes of 9 to 24 m, turned every way, up to 17 m apart in blocks of four,
// with streets of about 20 m between the blocks; they do not touch. About a fifth of the ground is
// built on. The middle of the town is the origin.
std::vector<Ring> RandomTown(uint64_t seed, int buildings);

}  // namespace stucco
