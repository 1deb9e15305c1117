// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/dipping/setting.h"

namespace stucco::plan {

DippingSetting MakeSetting(const Site& site, const Obstacles& obstacles, const CameraPreset& camera,
                           double d_max_m) {
  return {.site = site,
          .obstacles = obstacles,
          .hfov_rad = camera.HorizontalFov(),
          .width_per_m = camera.WidthAt(1),
          .height_per_m = camera.HeightAt(1),
          .d_min_m = site.d_min_m,
          .d_max_m = d_max_m};
}

}  // namespace stucco::plan
