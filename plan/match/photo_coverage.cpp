// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/match/photo_coverage.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "plan/match/photo_graph.h"

namespace stucco::plan {

namespace {

// Pixels that are larger by no more count as what was asked for.
constexpr double kSpare = 1.1;
constexpr double kLeastShare = 0.05;  // that is worth a warning

}  // namespace

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

std::vector<std::string> CoverageWarnings(const PhotoCoverage& coverage, double asked_m) {
  int shown = 0, coarse = 0;
  double largest_m = 0;
  for (const CoveredPlace& place : coverage.places) {
    if (place.kind != SurfaceKind::kWall || !(place.gsd_m > 0)) continue;
    ++shown;
    if (place.gsd_m <= kSpare * asked_m) continue;
    ++coarse;
    largest_m = std::max(largest_m, place.gsd_m);
  }
  if (coarse <= kLeastShare * shown) return {};
  return {fmt::format(
      "pixels are larger than the {:.1f} cm asked for on {:.0f} % of the walls (up to {:.1f} cm): "
      "what "
      "nothing dips to is shown from the safe altitude alone (coverage.svg). A longer lens, or a "
      "smaller --d-min, brings it nearer",
      100 * asked_m, 100.0 * coarse / shown, 100 * largest_m)};
}

}  // namespace stucco::plan
