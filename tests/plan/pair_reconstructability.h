// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "plan/planar/reconstructability.h"

namespace stucco::plan {

// The definition, which the planner sums up faster: w1 w2 w3 w4 cos(t) of one pair of cameras at c
// and d; 0 where one of them is behind the surface.
inline double PairReconstructability(const Eigen::Vector3d& point, const Eigen::Vector3d& normal,
                                     const Eigen::Vector3d& c, const Eigen::Vector3d& d,
                                     double d_max_m) {
  const double c_distance = (c - point).norm();
  const double d_distance = (d - point).norm();
  if (!(c_distance > 0) || !(d_distance > 0)) return 0;
  const Eigen::Vector3d to_c = (c - point) / c_distance;
  const Eigen::Vector3d to_d = (d - point) / d_distance;
  const double angle = std::acos(std::clamp(to_c.dot(to_d), -1.0, 1.0));
  const double cosine = std::min(to_c.dot(normal), to_d.dot(normal));
  if (!(cosine > 0)) return 0;
  return ParallaxWeight(angle) * ResolutionWeight(std::max(c_distance, d_distance), d_max_m) *
         MatchWeight(angle) * ScaleWeight(c_distance, d_distance) * cosine;
}

}  // namespace stucco::plan
