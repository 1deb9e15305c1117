// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/cloud/grid_index.h"

#include <algorithm>

namespace stucco {

GridIndex::GridIndex(std::span<const Eigen::Vector3d> points, double cell)
    : points_(points), cell_(cell), order_(points.size()) {
  if (!points.empty()) {
    origin_ = points[0];
    for (const auto& point : points) origin_ = origin_.cwiseMin(point);
  }
  std::vector<std::pair<uint64_t, uint32_t>> keyed(points.size());
  for (size_t i = 0; i < points.size(); ++i) {
    keyed[i] = {Key(Cell(points[i].array())), static_cast<uint32_t>(i)};
  }
  std::sort(keyed.begin(), keyed.end());
  for (size_t first = 0; first < keyed.size();) {
    size_t last = first;
    while (last < keyed.size() && keyed[last].first == keyed[first].first) {
      order_[last] = keyed[last].second;
      ++last;
    }
    ranges_[keyed[first].first] = {static_cast<uint32_t>(first), static_cast<uint32_t>(last)};
    first = last;
  }
}

}  // namespace stucco
