// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/match/photo_coverage.h"

#include <cmath>

#include "plan/match/photo_graph.h"

namespace stucco::plan {

PhotoCoverage CoverageOf(const PhotoGraph& photos, const PlannedCamera& camera) {
  PhotoCoverage out;
  out.spacing_m = std::sqrt(photos.patch_m2);
  for (const SurfaceSample& sample : photos.view.samples) {
    out.places.push_back({sample.position, sample.normal, sample.kind});
  }
  const double pixels = static_cast<double>(camera.width_px) * camera.height_px;
  for (uint32_t photo = 0; photo < photos.graph.size(); ++photo) {
    for (const Sight& sight : photos.graph.sights(photo)) {
      CoveredPlace& place = out.places[sight.sample];
      ++place.photos;
      if (!(sight.share > 0)) continue;
      const double gsd = std::sqrt(photos.patch_m2 / (sight.share * pixels));
      if (place.gsd_m == 0 || gsd < place.gsd_m) place.gsd_m = gsd;
    }
  }
  return out;
}

}  // namespace stucco::plan
