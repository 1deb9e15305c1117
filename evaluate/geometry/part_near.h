// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "evaluate/geometry/surface_index.h"

namespace stucco::evaluate {

// The part of a surface that lies no farther than `reach_m` from `things`. Large triangles are cut
// for it; at the border it is right to a quarter of a metre.
Surface PartNear(const Surface& surface, const SurfaceIndex& things, double reach_m);

}  // namespace stucco::evaluate
