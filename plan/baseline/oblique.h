// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "plan/planar/grid_hovers.h"

namespace stucco::plan {

// Oblique photography, the method `oblique` of the paper's comparison: every hover of the grid with
// its five photos, none meant for a facade. Throws Error (kBadInput).
std::vector<Hover> ObliqueViews(const Site& site, const CameraPreset& camera,
                                const GridOptions& options);

}  // namespace stucco::plan
