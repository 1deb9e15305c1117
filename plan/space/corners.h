// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <vector>

#include "plan/site.h"
#include "survey/geometry2d.h"

namespace stucco::plan {

// A convex corner of a dilated outline: the only places where a shortest path bends. The border
// comes in along `in` and leaves along `out` (unit vectors), the obstacle on its left.
struct Corner {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();
  Eigen::Vector2d in = Eigen::Vector2d::UnitX();
  Eigen::Vector2d out = Eigen::Vector2d::UnitX();

  // Whether a straight line along `direction` touches the border here without cutting it; only such
  // lines are part of a shortest path. The way along it does not matter.
  bool IsTangent(const Eigen::Vector2d& direction) const {
    const double from_in = Cross(in, direction);
    const double to_out = Cross(direction, out);
    // Within the cone between in and out, or that of the other way round.
    const double tolerance = 1e-9 * (std::abs(direction.x()) + std::abs(direction.y()));
    return (from_in >= -tolerance && to_out >= -tolerance) ||
           (from_in <= tolerance && to_out <= tolerance);
  }
};

// Corners of the outline dilated by `radius`, arcs replaced by polygons around them whose sides
// turn by at most `step_rad`: nothing that they enclose is nearer than `radius` to the outline's
// corner. Corners that turn inwards are left out.
std::vector<Corner> DilatedCorners(const Polygon& outline, double radius, double step_rad);

}  // namespace stucco::plan
