// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/map/plan_bins.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace stucco {

PlanBins::PlanBins(std::span<const Eigen::Vector3d> points, double cell) : cell_(cell) {
  assert(cell > 0);
  for (size_t i = 0; i < points.size(); ++i) {
    points_[CellOf(points[i].head<2>())].push_back(static_cast<int>(i));
  }
}

std::pair<int, int> PlanBins::CellOf(const Eigen::Vector2d& p) const {
  return {static_cast<int>(std::floor(p.x() / cell_)), static_cast<int>(std::floor(p.y() / cell_))};
}

std::vector<int> PlanBins::In(const Eigen::AlignedBox2d& box) const {
  std::vector<int> found;
  if (box.isEmpty()) return found;
  const auto [low_x, low_y] = CellOf(box.min());
  const auto [high_x, high_y] = CellOf(box.max());
  for (int x = low_x; x <= high_x; ++x) {
    const auto end = points_.upper_bound({x, high_y});
    for (auto bin = points_.lower_bound({x, low_y}); bin != end; ++bin) {
      found.insert(found.end(), bin->second.begin(), bin->second.end());
    }
  }
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace stucco
