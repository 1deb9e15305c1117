// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "plan/camera/hover.h"
#include "plan/camera/preset.h"
#include "plan/planar/grid_hovers.h"
#include "site/site.h"
#include "survey/stage.h"

namespace stucco::plan {

struct PlanarOptions {
  GridOptions grid;
  double d_max_m = 0;  // farthest surface that a view counts for; beyond the safe altitude
  // Least reconstructability that removal leaves; 0: six good pairs at the safe altitude.
  double tau_r = 0;
  double sample_spacing_m = 0;  // 0: three quarters of the grid, from 3.5 to 8 m
  int threads = 1;
};

// Views from above, for geometry, roofs and ground (section 5 of the paper): the grid of five-view
// hovers, thinned out and moved as long as that gains anything, given what the `dipping` hovers see
// already. Removal comes first, as neighbours in the full grid would only take each other's place.
// In the end every square metre of a facade that the full grid sees is still seen.
// Same result at any number of threads. Throws Error (kBadInput, kInterrupted).
std::vector<Hover> PlanarViews(const Site& site, const CameraPreset& camera,
                               const PlanarOptions& options, std::span<const Hover> dipping,
                               Progress& progress);

}  // namespace stucco::plan
