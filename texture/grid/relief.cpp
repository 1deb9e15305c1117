// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/grid/relief.h"

#include <algorithm>
#include <cmath>

namespace stucco {

int Relief::Column(double u) const {
  return std::clamp(static_cast<int>(std::floor(u / cell)), 0, width - 1);
}

int Relief::Row(double v) const {
  return std::clamp(static_cast<int>(std::floor(v / cell)), 0, height - 1);
}

double Relief::HeightAt(double u, double v) const {
  return heights[static_cast<size_t>(Row(v)) * width + Column(u)];
}

bool Relief::IsLevel(const Eigen::Vector2d& low, const Eigen::Vector2d& high) const {
  const auto first = static_cast<float>(HeightAt(low.x(), low.y()));
  for (int row = Row(low.y()); row <= Row(high.y()); ++row) {
    for (int column = Column(low.x()); column <= Column(high.x()); ++column) {
      if (heights[static_cast<size_t>(row) * width + column] != first) return false;
    }
  }
  return true;
}

bool Relief::Hides(const Eigen::Vector3d& point, const Eigen::Vector3d& camera) const {
  const Eigen::Vector3d way = camera - point;
  if (!(way.z() > 0)) return true;
  // Edges are not known to better than a cell, heights to a step.
  const double reach = std::min(1.0, (highest - point.z()) / way.z());
  const double stride = cell / 2 / std::max(way.head<2>().norm(), cell);
  for (double t = 3 * stride; t < reach; t += stride) {
    const Eigen::Vector3d at = point + t * way;
    if (HeightAt(at.x(), at.y()) > at.z() + step) return true;
  }
  return false;
}

}  // namespace stucco
