// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "proxy/cloud/scale.h"
#include "proxy/facets/raster.h"
#include "proxy/map/roof_planes.h"

namespace stucco {

// Cells of a raster over the ground plan that photos look through below the roof, to a wall behind:
// nothing stands there, whether the ground shows or not, but what the photos look over (a shed) or
// what they look below (a balcony). A photo that would look below a roof that was seen, but for the
// eaves of that wall, sees a mirror image or an error of stereo, and tells nothing; strays over a
// cell (fewer than half of the samples that the cloud's spacing promises) are no roof. All zero
// where no roof was found.
std::vector<char> SeenThrough(const RoofEvidence& evidence, const PlaneRaster& raster,
                              const Tolerances& tolerances);

}  // namespace stucco
