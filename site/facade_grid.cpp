// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "site/facade_grid.h"

#include <algorithm>
#include <cmath>

namespace stucco {
namespace {

constexpr double kGridCell_m = 1;
constexpr int kFewestColumns = 3;
constexpr int kFewestRows = 2;
constexpr double kMostCells = 400;

}  // namespace

FacadeGrid::FacadeGrid(const Facade& facade)
    : a(facade.a), along(facade.along()), length_m(facade.length_m()), z_m(facade.z_m) {
  const double height = z_m.length_m();
  const double size = std::max(kGridCell_m, std::sqrt(length_m * height / kMostCells));
  columns = std::max(kFewestColumns, static_cast<int>(std::lround(length_m / size)));
  rows = std::max(kFewestRows, static_cast<int>(std::lround(height / size)));
}

Interval FacadeGrid::Along(uint32_t cell) const {
  const double step = length_m / columns;
  const int column = static_cast<int>(cell) % columns;
  return {column * step, (column + 1) * step};
}

Interval FacadeGrid::Heights(uint32_t cell) const {
  const double step = z_m.length_m() / rows;
  const int row = static_cast<int>(cell) / columns;
  return {z_m.from_m + row * step, z_m.from_m + (row + 1) * step};
}

Eigen::Vector3d FacadeGrid::Center(uint32_t cell) const {
  const Interval u = Along(cell);
  const Interval v = Heights(cell);
  const Eigen::Vector2d at = a + 0.5 * (u.from_m + u.to_m) * along;
  return {at.x(), at.y(), 0.5 * (v.from_m + v.to_m)};
}

}  // namespace stucco
