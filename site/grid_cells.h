// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "site/site.h"
#include "survey/geometry2d.h"

namespace stucco {

// A cell of the square grid that covers the plane, cell (0, 0) having the origin as its corner.
struct GridCell {
  int32_t row = 0;
  int32_t column = 0;
  auto operator<=>(const GridCell&) const = default;  // NOLINT(modernize-use-nullptr)
};
inline Eigen::Vector2d CenterOf(const GridCell& cell, double size_m) {
  return size_m * Eigen::Vector2d(cell.column + 0.5, cell.row + 0.5);
}

// The cells with their centre inside the polygon, in ascending order.
std::vector<GridCell> CellsInside(const Polygon& polygon, double size_m);
// The cells with their centre within `reach_m` of a border of the polygon, in ascending order.
std::vector<GridCell> CellsNear(const Polygon& polygon, double size_m, double reach_m);

// The same around a straight line.
std::vector<GridCell> CellsNearLine(const Segment2d& line, double size_m, double reach_m);

// Unit direction of the longer side of the smallest rectangle around the polygon, in the half plane
// east (or north) of the origin.
Eigen::Vector2d MainAxis(const Polygon& polygon);

}  // namespace stucco
