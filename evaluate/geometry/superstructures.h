// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "evaluate/geometry/surface_index.h"
#include "survey/proxy.h"

namespace stucco::evaluate {

// How many facets of a result's buildings are of what stands on a roof: heads of stairs, chimneys,
// large vents. They are right, but the planar truth has none of them. A facet counts where most of
// its area lies over a roof of that truth, off all of its planes, and on what stands out from them.
// The result and both surfaces are in the frame of the truth.
int CountSuperstructures(const Proxy& result, const Surface& planes, const SurfaceIndex& relief);

}  // namespace stucco::evaluate
