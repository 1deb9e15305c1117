// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/space/box_tree.h"

#include <numeric>

namespace stucco::plan {
namespace {

constexpr int kLeafSize = 4;

}  // namespace

BoxTree::BoxTree(std::span<const Box2> boxes) : items_(boxes.size()) {
  if (boxes.empty()) return;
  std::iota(items_.begin(), items_.end(), 0);
  nodes_.emplace_back();
  Split(0, 0, static_cast<int>(boxes.size()), boxes);
}

void BoxTree::Split(int node, int first, int count, std::span<const Box2> boxes) {
  Box2 box;
  Box2 centres;
  for (int k = first; k < first + count; ++k) {
    box.Add(boxes[items_[k]]);
    centres.Add(Eigen::Vector2d(boxes[items_[k]].min + boxes[items_[k]].max));
  }
  nodes_[node].box = box;
  if (count <= kLeafSize) {
    nodes_[node].first = first;
    nodes_[node].count = count;
    return;
  }
  const Eigen::Vector2d size = centres.max - centres.min;
  const int axis = size.x() >= size.y() ? 0 : 1;
  const auto key = [&](int item) { return boxes[item].min[axis] + boxes[item].max[axis]; };
  const int half = count / 2;
  std::nth_element(items_.begin() + first, items_.begin() + first + half,
                   items_.begin() + first + count,
                   [&](int i, int j) { return key(i) != key(j) ? key(i) < key(j) : i < j; });
  const int children = static_cast<int>(nodes_.size());
  nodes_[node].first = children;
  nodes_.resize(nodes_.size() + 2);
  Split(children, first, half, boxes);
  Split(children + 1, first + half, count - half, boxes);
}

}  // namespace stucco::plan
