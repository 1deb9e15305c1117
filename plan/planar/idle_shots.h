// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "plan/camera/hover.h"
#include "plan/camera/preset.h"
#include "site/sightings.h"
#include "site/site.h"

namespace stucco::plan {

struct IdleSetting {
  const Site& site;
  const SurfaceView& view;  // walls, roofs and the ground around them
  double patch_m2 = 0;      // of a sample
  const CameraPreset& camera;
  double d_max_m = 0;  // farthest that a wall counts as seen from
  int threads = 1;
};

// Takes out the photos of which what is to be captured fills less than a tenth, and hovers without
// any left. One that is needed to see every square metre of a facade that the hovers see together
// with `others` stays. Returns how many are gone.
size_t DropIdleShots(const IdleSetting& setting, std::span<const Hover> others,
                     std::vector<Hover>& hovers);

}  // namespace stucco::plan
