// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "proxy/map/fitted_building.h"

namespace stucco {

// Metres along which two footprints touch, with the corners of `wing` put onto the edges of `house`
// where they lie within some centimetres of them.
double ContactOf(const FittedBuilding& house, const FittedBuilding& wing);

// The house with a wing that its map lacks as one more part, whose corners lie on the house's
// edges, so that no wall is between them. Its edges have no facades, its foot is the lower one of
// both. Requires that they touch.
FittedBuilding WithWing(FittedBuilding house, const FittedBuilding& wing);

// Whether the footprint leans on the house as a wing does: by some metres of wall, and smaller than
// the house. What is as large is a house of its own.
bool IsWingOf(const FittedBuilding& house, const FittedBuilding& wing);

}  // namespace stucco
