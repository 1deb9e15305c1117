// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "plan/camera/hover.h"
#include "plan/camera/preset.h"
#include "site/site.h"
#include "survey/stage.h"

namespace stucco::plan {

struct DroneScanOptions {
  double d_max_m = 0;
  double view_distance_m = 0;   // from the surface; 0: twice d_min, or d_max where that is less
  double sample_spacing_m = 0;  // 0: what an overlap of 0.8 asks for at that distance
};

// The method `dronescan` of the paper's comparison: Zhou et al., "Offsite Aerial Path Planning for
// Efficient Urban Scene Reconstruction" (2020). One candidate view per sample of the 2.5D model, at
// the view distance along its normal and facing it; then views that others make redundant go, those
// first whose worst sample is the best reconstructable. One photo per hover, none meant for a
// facade. The paper's continuous adjustment of the views that stay is left out. Same result at any
// number of threads. Throws Error (kInterrupted).
std::vector<Hover> DroneScanViews(const Site& site, const CameraPreset& camera,
                                  const DroneScanOptions& options, int threads, Progress& progress);

}  // namespace stucco::plan
