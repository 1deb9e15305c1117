// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

namespace stucco {

// Neighbours within a radius, by cells of a cubic grid. Visits points in the same order on every
// run. Keeps a view of the points: they must outlive the index.
class GridIndex {
 public:
  GridIndex(std::span<const Eigen::Vector3d> points, double cell);

  const Eigen::Vector3d& point(int index) const { return points_[index]; }

  // fn(index) for every point within `radius` of `center`, the point itself included.
  template <typename Fn>
  void ForEachNear(const Eigen::Vector3d& center, double radius, const Fn& fn) const {
    const double squared = radius * radius;
    const Eigen::Array3i low = Cell(center.array() - radius);
    const Eigen::Array3i high = Cell(center.array() + radius);
    for (int x = low.x(); x <= high.x(); ++x) {
      for (int y = low.y(); y <= high.y(); ++y) {
        for (int z = low.z(); z <= high.z(); ++z) ForEachIn({x, y, z}, center, squared, fn);
      }
    }
  }

 private:
  template <typename Fn>
  void ForEachIn(const Eigen::Array3i& cell, const Eigen::Vector3d& center, double squared,
                 const Fn& fn) const {
    const auto found = ranges_.find(Key(cell));
    if (found == ranges_.end()) return;
    const auto [begin, end] = found->second;
    for (const uint32_t point : std::span(order_).subspan(begin, end - begin)) {
      if ((points_[point] - center).squaredNorm() <= squared) fn(static_cast<int>(point));
    }
  }

  Eigen::Array3i Cell(const Eigen::Array3d& point) const {
    return ((point - origin_.array()) / cell_).floor().cast<int>();
  }

  static uint64_t Key(const Eigen::Array3i& cell) {
    constexpr int kHalf = 1 << 20;
    return (static_cast<uint64_t>(cell.x() + kHalf) & 0x1fffff) << 42 |
           (static_cast<uint64_t>(cell.y() + kHalf) & 0x1fffff) << 21 |
           (static_cast<uint64_t>(cell.z() + kHalf) & 0x1fffff);
  }

  std::span<const Eigen::Vector3d> points_;
  double cell_;
  Eigen::Vector3d origin_ = Eigen::Vector3d::Zero();
  std::vector<uint32_t> order_;
  std::unordered_map<uint64_t, std::pair<uint32_t, uint32_t>> ranges_;
};

}  // namespace stucco
