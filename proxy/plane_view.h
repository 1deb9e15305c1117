// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "proxy/arrangement.h"
#include "proxy/plane.h"
#include "proxy/raster.h"
#include "proxy/samples.h"
#include "proxy/scale.h"
#include "proxy/stations.h"

namespace stucco {

// A plane with what is known about each of its parts.
struct PlaneView {
  const Plane* plane = nullptr;
  bool ground = false;  // walls near it reach down to it, whether it was seen there or not
  PlaneRaster raster;
  std::vector<Evidence> evidence;
  std::vector<float> to_seen;  // distance of each cell to the nearest seen one, world units
};

// Planes from index `first_ground` on are the ground. `witnesses` are the samples whose rays may
// show openings (those that lie on planes). The views point into `planes`, which must outlive them.
std::vector<PlaneView> ViewPlanes(const Samples& samples, const Stations& stations,
                                  std::span<const Plane> planes, const std::vector<int>& witnesses,
                                  const Eigen::Vector3d& up, const Eigen::Vector3d& main_direction,
                                  const Tolerances& tolerances, size_t first_ground, int threads);

// The intersection with each of the `others` that comes within `reach` of the seen parts of both
// planes along at least `min_length`, as a line in the frame of `view`. The ground counts as seen
// everywhere, from one and a half times `reach`, but is no foot of a wall that was seen below it.
// Planes within 10 degrees of parallel have none.
std::vector<CutLine> Creases(const PlaneView& view, std::span<const PlaneView* const> others,
                             double reach, double min_length);

}  // namespace stucco
