// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "plan/camera/hover.h"
#include "plan/camera/preset.h"
#include "plan/evaluate/facade_sight.h"
#include "site/site.h"

namespace stucco::plan {

// The cells that a view sees and is meant for: within one of its targets on the facade. A target
// whose intervals are both empty means all that the view sees.
std::vector<uint32_t> MeantCells(const FacadeSight& sight, int facade, const SeenView& view);

// Gives photos a target wherever they see walls that none is meant for yet, as a texturing step
// would choose them: per facade, the photo with the best view-facade quality (eq. 2) weighted by
// the part it newly covers, until none covers more. The target is the box around that part. Facades
// that existing targets cover are left alone. So it serves what dipping views leave over.
void AssignViews(const Site& site, const CameraPreset& camera, double d_max_m,
                 std::vector<Hover>& hovers, int threads);

// Predicted quality of one facade.
struct FacadeReport {
  FacadeQuality meant;  // of the photos meant for it, each counted for the part it is meant for
  int views = 0;        // of these, that see some of it
  double covered = 0;   // share of the facade
  FacadeQuality all;    // of all photos that see it, each counted for all it sees
  double covered_all = 0;
};

// One report per facade of the site: the same measure for every planning method.
std::vector<FacadeReport> EvaluateFacades(const Site& site, const CameraPreset& camera,
                                          double d_max_m, std::span<const Hover> hovers,
                                          int threads);

}  // namespace stucco::plan
