// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "plan/space/obstacles.h"

namespace stucco::plan {

// A way on the map and the heights at its ends.
struct Track {
  std::vector<Eigen::Vector2d> points;  // at least two
  double start_z = 0;
  double end_z = 0;
};

// The shortest path in space over a track that stays above the ground and above the footprints that
// are not blocked beyond `level_m`: a string pulled tight over them, in the upright surface through
// the track. Higher footprints are the track's own business.
std::vector<Eigen::Vector3d> Lift(const Obstacles& obstacles, const Track& track, double level_m);

double Length(const std::vector<Eigen::Vector3d>& points);

}  // namespace stucco::plan
