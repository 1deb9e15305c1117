// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "proxy/cloud/scale.h"
#include "proxy/map/extrude_cells.h"
#include "proxy/map/outline_fit.h"
#include "proxy/map/roof_planes.h"

namespace stucco {

// Roofs that fall to an edge of the outline, by their samples along it, fall squarely to it, and
// those whose eaves are of nearly one height get one. Then hips and valleys run through the corners
// of the outline exactly: past one by a millimetre they would leave a sliver of a wall that no file
// can hold. No roof is moved or turned by more than 5 cm, nor than the tolerance of planes.
// `roofs[i]` is evidence.planes[planes[i]].
void LevelEaves(const FittedBuilding& building, const RoofEvidence& evidence,
                std::span<const int> planes, const Tolerances& tolerances,
                std::vector<RoofPlane>& roofs);

}  // namespace stucco
