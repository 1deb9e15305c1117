// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "plan/camera/preset.h"
#include "plan/space/obstacles.h"
#include "site/site.h"

namespace stucco::plan {

// What the dipping views are planned with.
struct DippingSetting {
  const Site& site;
  const Obstacles& obstacles;
  double hfov_rad = 0;
  double width_per_m = 0;  // of the wall in a photo, per metre of distance
  double height_per_m = 0;
  double d_min_m = 0;
  double d_max_m = 0;
  double vertical_step = 0.8;  // k_d
  int threads = 1;
};
DippingSetting MakeSetting(const Site& site, const Obstacles& obstacles, const CameraPreset& camera,
                           double d_max_m);

}  // namespace stucco::plan
