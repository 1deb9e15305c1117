// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/planes/find_planes.h"

#include "proxy/planes/consolidate.h"
#include "proxy/planes/detect.h"

namespace stucco {

std::vector<Plane> FindPlanes(const Samples& samples, const GridIndex& index,
                              const std::vector<double>& agreement, const Tolerances& tolerances,
                              const ProxyOptions& options) {
  auto planes = DetectPlanes(
      samples, index, agreement,
      {.radius = tolerances.radius,
       .epsilon = tolerances.epsilon,
       .normal_angle_deg = options.normal_angle_deg,
       .min_points = options.min_points > 0 ? options.min_points : LeastPoints(tolerances)});
  MergeCoplanar(samples, tolerances, options.normal_angle_deg, planes);
  AdoptNeighbours(samples, index, tolerances, options.normal_angle_deg, planes);
  MergeCoplanar(samples, tolerances, options.normal_angle_deg, planes);
  DropClutter(samples, tolerances, options.normal_angle_deg, planes);
  return planes;
}

}  // namespace stucco
