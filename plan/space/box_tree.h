// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <span>
#include <vector>

#include "survey/geometry2d.h"

namespace stucco::plan {

struct Box2 {
  Eigen::Vector2d min = Eigen::Vector2d::Constant(1e300);
  Eigen::Vector2d max = Eigen::Vector2d::Constant(-1e300);

  void Add(const Eigen::Vector2d& point) {
    min = min.cwiseMin(point);
    max = max.cwiseMax(point);
  }
  void Add(const Box2& other) {
    Add(other.min);
    Add(other.max);
  }
  bool Contains(const Eigen::Vector2d& point) const {
    return (point.array() >= min.array()).all() && (point.array() <= max.array()).all();
  }
  double SquaredDistance(const Eigen::Vector2d& point) const {
    return (min - point).cwiseMax(point - max).cwiseMax(0).squaredNorm();
  }
  // False only when every point of the segment is farther than `radius` (a separating axis among
  // x, y and the segment's normal).
  bool MayTouch(const Segment2d& segment, double radius) const {
    const Eigen::Vector2d low = segment.a.cwiseMin(segment.b);
    const Eigen::Vector2d high = segment.a.cwiseMax(segment.b);
    if (low.x() > max.x() + radius || high.x() < min.x() - radius) return false;
    if (low.y() > max.y() + radius || high.y() < min.y() - radius) return false;
    const Eigen::Vector2d d = segment.b - segment.a;
    const Eigen::Vector2d half = 0.5 * (max - min);
    const double offset = std::abs(Cross(d, 0.5 * (min + max) - segment.a));
    const double reach = std::abs(d.x()) * half.y() + std::abs(d.y()) * half.x();
    return offset <= reach + radius * d.norm() * (1 + 1e-12);
  }
};

// Boxes in a balanced binary tree, leaves of a few boxes.
class BoxTree {
 public:
  BoxTree() = default;
  explicit BoxTree(std::span<const Box2> boxes);

  // Calls leaf(item) for the boxes under nodes that enter(box) lets pass, until one returns true.
  template <typename Enter, typename Leaf>
  bool Any(const Enter& enter, const Leaf& leaf) const {
    std::array<int, 64> open;  // a balanced tree is not deeper
    int size = 0;
    if (!nodes_.empty()) open[size++] = 0;
    while (size > 0) {
      const Node& node = nodes_[open[--size]];
      if (!enter(node.box)) continue;
      for (int k = node.first; k < node.first + node.count; ++k) {
        if (leaf(items_[k])) return true;
      }
      if (node.count > 0) continue;
      open[size++] = node.first + 1;
      open[size++] = node.first;
    }
    return false;
  }

  bool empty() const { return nodes_.empty(); }
  const Box2& box() const { return nodes_.front().box; }

 private:
  struct Node {
    Box2 box;
    int first = 0;  // the first of two children, or of `count` items
    int count = 0;  // 0: an inner node
  };
  void Split(int node, int first, int count, std::span<const Box2> boxes);

  std::vector<Node> nodes_;
  std::vector<int> items_;
};

}  // namespace stucco::plan
