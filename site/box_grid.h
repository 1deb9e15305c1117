// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace stucco {

// Finds the boxes near a place without looking at all of them: a grid of square cells, each with
// the boxes that touch it.
class BoxGrid {
 public:
  // Cells about as large as a box keep both the grid and a look-up small.
  BoxGrid(std::span<const Eigen::AlignedBox2d> boxes, double cell_m);

  // Indices of the boxes that touch `box`, ascending.
  std::vector<int> Touching(const Eigen::AlignedBox2d& box) const;

 private:
  Eigen::Array2d Cell(const Eigen::Vector2d& position) const;

  double cell_m_;
  Eigen::AlignedBox2d bounds_;
  std::vector<Eigen::AlignedBox2d> boxes_;
  std::vector<std::pair<uint64_t, int>> entries_;  // cell (row, column) and box, sorted
};

}  // namespace stucco
