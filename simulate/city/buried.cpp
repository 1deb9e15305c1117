// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulate/city/buried.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "survey/geometry2d.h"

namespace stucco::simulate {
namespace {

using Eigen::Vector2d;

// Column and row of the cell at a place in the axes of the ground.
std::pair<int, int> CellAt(const GroundGrid& grid, const Vector2d& at) {
  const auto index = [](const std::vector<double>& lines, double value) {
    const auto next = std::upper_bound(lines.begin() + 1, lines.end() - 1, value);
    return static_cast<int>(next - lines.begin()) - 1;
  };
  return {index(grid.x, at.x()), index(grid.y, at.y())};
}

// Where a segment in the axes of the ground crosses from one triangle of it to the next: shares of
// its length, ascending, with both ends.
std::vector<double> Crossings(const GroundGrid& grid, const Vector2d& a, const Vector2d& b) {
  std::vector<double> at = {0, 1};
  const auto add = [&](double from, double to) {  // where a linear function changes its sign
    if ((from < 0) != (to < 0)) at.push_back(from / (from - to));
  };
  for (const double x : grid.x) add(a.x() - x, b.x() - x);
  for (const double y : grid.y) add(a.y() - y, b.y() - y);
  std::sort(at.begin(), at.end());
  const std::vector<double> cells = at;
  for (size_t i = 0; i + 1 < cells.size(); ++i) {  // the diagonals
    const Vector2d from = a + cells[i] * (b - a);
    const Vector2d to = a + cells[i + 1] * (b - a);
    const auto [column, row] = CellAt(grid, (from + to) / 2);
    const Vector2d low(grid.x[column], grid.y[row]);
    const Vector2d diagonal = Vector2d(grid.x[column + 1], grid.y[row + 1]) - low;
    const double before = Cross(diagonal, from - low);
    const double after = Cross(diagonal, to - low);
    if ((before < 0) == (after < 0)) continue;
    at.push_back(cells[i] + before / (before - after) * (cells[i + 1] - cells[i]));
  }
  std::sort(at.begin(), at.end());
  return at;
}

// The area between 0 and what is positive of a linear function over `length`.
double PositiveArea(double from, double to, double length) {
  if (from <= 0 && to <= 0) return 0;
  if (from >= 0 && to >= 0) return (from + to) / 2 * length;
  const double high = std::max(from, to);
  return high * high / (2 * std::abs(to - from)) * length;
}

}  // namespace

double BuriedArea(const Town& town, const GroundGrid& grid, const Vector2d& a, const Vector2d& b,
                  double foot_m) {
  const Eigen::Rotation2Dd turn(-town.turn_rad);
  const Vector2d from = turn * a;
  const Vector2d along = turn * b - from;
  const std::vector<double> at = Crossings(grid, from, from + along);
  double area = 0;
  for (size_t i = 0; i + 1 < at.size(); ++i) {
    const auto [column, row] = CellAt(grid, from + (at[i] + at[i + 1]) / 2 * along);
    const auto above_foot = [&, column = column, row = row](double share) {
      return DrawnHeight(town, grid, column, row, from + share * along) - foot_m;
    };
    area +=
        PositiveArea(above_foot(at[i]), above_foot(at[i + 1]), (at[i + 1] - at[i]) * along.norm());
  }
  return area;
}

}  // namespace stucco::simulate
