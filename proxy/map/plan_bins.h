// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <map>
#include <span>
#include <utility>
#include <vector>

namespace stucco {

// Points by cells of the ground plan: which lie above or below a piece of it.
class PlanBins {
 public:
  // By x and y of the points.
  PlanBins(std::span<const Eigen::Vector3d> points, double cell);

  // Indices of the points whose cells meet the box, ascending.
  std::vector<int> In(const Eigen::AlignedBox2d& box) const;

 private:
  std::pair<int, int> CellOf(const Eigen::Vector2d& p) const;

  double cell_;
  std::map<std::pair<int, int>, std::vector<int>> points_;
};

}  // namespace stucco
