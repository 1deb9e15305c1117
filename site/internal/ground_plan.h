// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "site/site.h"

namespace stucco::internal {

// The site from above in square cells, with the footprint that covers each or lies nearest.
struct GroundPlan {
  Eigen::Vector2d low = Eigen::Vector2d::Zero();
  double cell_m = 1;
  int columns = 0;
  int rows = 0;
  std::vector<int> nearest;  // index of a footprint, -1: none
  std::vector<bool> covered;

  Eigen::Vector2i CellOf(const Eigen::Vector2d& place) const {
    return ((place - low) / cell_m).array().floor().cast<int>();
  }
  // Index of a cell; nothing beyond the edge.
  std::optional<size_t> Cell(int column, int row) const {
    if (column < 0 || row < 0 || column >= columns || row >= rows) return std::nullopt;
    return static_cast<size_t>(row) * columns + column;
  }
  Eigen::Vector2d Middle(size_t cell) const {
    const size_t column = cell % columns, row = cell / columns;
    return low + cell_m * Eigen::Vector2d(static_cast<double>(column) + 0.5,
                                          static_cast<double>(row) + 0.5);
  }
};

// All footprints and this much around them; empty where there are none.
Eigen::AlignedBox2d BoundsWithMargin(const Site& site, double margin_m);

GroundPlan MakeGroundPlan(const Site& site, const Eigen::AlignedBox2d& area, double cell_m);

}  // namespace stucco::internal
