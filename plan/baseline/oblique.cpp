// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/baseline/oblique.h"

namespace stucco::plan {

std::vector<Hover> ObliqueViews(const Site& site, const CameraPreset& camera,
                                const GridOptions& options) {
  return GridHovers(site, camera, options);
}

}  // namespace stucco::plan
