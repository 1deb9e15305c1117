// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "site/box_grid.h"

#include <algorithm>

namespace stucco {
namespace {

uint64_t Key(double row, double column) {
  return static_cast<uint64_t>(row) << 32 | static_cast<uint64_t>(column);
}

}  // namespace

BoxGrid::BoxGrid(std::span<const Eigen::AlignedBox2d> boxes, double cell_m)
    : cell_m_(cell_m), boxes_(boxes.begin(), boxes.end()) {
  for (const Eigen::AlignedBox2d& box : boxes_) bounds_.extend(box);
  for (size_t i = 0; i < boxes_.size(); ++i) {
    if (boxes_[i].isEmpty()) continue;
    const Eigen::Array2d low = Cell(boxes_[i].min());
    const Eigen::Array2d high = Cell(boxes_[i].max());
    for (double row = low.y(); row <= high.y(); ++row) {
      for (double column = low.x(); column <= high.x(); ++column) {
        entries_.emplace_back(Key(row, column), static_cast<int>(i));
      }
    }
  }
  std::sort(entries_.begin(), entries_.end());
}

Eigen::Array2d BoxGrid::Cell(const Eigen::Vector2d& position) const {
  return ((position - bounds_.min()) / cell_m_).array().floor();
}

std::vector<int> BoxGrid::Touching(const Eigen::AlignedBox2d& box) const {
  std::vector<int> found;
  const Eigen::AlignedBox2d part = box.intersection(bounds_);
  if (part.isEmpty()) return found;
  const Eigen::Array2d low = Cell(part.min());
  const Eigen::Array2d high = Cell(part.max());
  for (double row = low.y(); row <= high.y(); ++row) {
    auto entry =
        std::lower_bound(entries_.begin(), entries_.end(), std::pair(Key(row, low.x()), 0));
    for (; entry != entries_.end() && entry->first <= Key(row, high.x()); ++entry) {
      if (boxes_[entry->second].intersects(box)) found.push_back(entry->second);
    }
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

}  // namespace stucco
