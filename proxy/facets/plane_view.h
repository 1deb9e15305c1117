// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "proxy/facets/arrangement.h"
#include "proxy/facets/raster.h"
#include "proxy/planes/plane.h"
#include "proxy/scene/scene.h"

namespace stucco {

// A plane with what is known about each of its parts.
struct PlaneView {
  const Plane* plane = nullptr;
  bool ground = false;  // walls near it reach down to it, whether it was seen there or not
  PlaneRaster raster;
  std::vector<Evidence> evidence;
  std::vector<float> to_seen;  // distance of each cell to the nearest seen one, world units
};

// Views `planes` of the scene, whose own lists of planes play no part. From index `first_ground` on
// they are the ground. The rays to the scene's support may show openings. The views point into
// `planes`, which must outlive them.
std::vector<PlaneView> ViewPlanes(const PlanarScene& scene, std::span<const Plane> planes,
                                  size_t first_ground, int threads);

// The intersection with each of the `others` that comes within `reach` of the seen parts of both
// planes along at least `min_length`, as a line in the frame of `view`. The ground counts as seen
// everywhere, from one and a half times `reach`, but is no foot of a wall that was seen below it.
// Planes within 10 degrees of parallel have none.
std::vector<CutLine> Creases(const PlaneView& view, std::span<const PlaneView* const> others,
                             double reach, double min_length);

}  // namespace stucco
