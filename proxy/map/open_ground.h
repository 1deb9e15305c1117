// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "proxy/cloud/scale.h"
#include "proxy/facets/raster.h"
#include "proxy/map/roof_planes.h"

namespace stucco {

// Metres from each cell of a raster over the ground plan to where the ground of a footprint lies
// open: it shows over a few square metres, or photos look through there (sight_lines.h), and
// nowhere in strips (strips are where an outline is a little too large), and nothing lies above it
// but the eaves of the walls beside; or it is hidden over up to 3 m between such ground and a wall
// that faces it. Empty where it lies open nowhere.
std::vector<float> DistancesToOpenGround(const RoofEvidence& evidence, const PlaneRaster& raster,
                                         const Tolerances& tolerances);

}  // namespace stucco
