// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "site/site.h"

namespace stucco {

// Lowest and highest ground under a polygon.
Interval GroundUnder(const Polygon& polygon, const TerrainGrid& terrain);

// Puts footprints whose `z_m` is above the ground, as maps give it, on the terrain of the site:
// heights count from the lowest ground under the building. Also fills in what follows from that:
// the tops of those without a known height (the expected one above the highest ground under the
// building where `z_m` has it, at most the highest that the safe altitude allows), `blocked_to_m`
// of all and the ceiling. `overgrown_to_m` is a z already.
void PlaceOnGround(Site& site);

}  // namespace stucco
