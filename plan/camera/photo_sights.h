// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "plan/camera/hover.h"
#include "site/sightings.h"

namespace stucco::plan {

// A sample of the site in one photo.
struct Sight {
  uint32_t sample = 0;
  float share = 0;                                // of the photo's frame that its patch fills
  Eigen::Vector3f way = Eigen::Vector3f::Zero();  // unit, from the sample to the camera
  float distance_m = 0;
};

// What one photo shows, ascending by sample. A sample stands for a patch of `patch_m2`.
std::vector<Sight> SightsOf(const SurfaceView& view, double patch_m2,
                            const Eigen::Vector3d& position, const Shot& shot);

}  // namespace stucco::plan
