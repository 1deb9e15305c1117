// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/path/nearest.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace stucco::plan {

using Eigen::Vector3d;

struct NearestPoints::Search {
  Vector3d position;
  size_t count = 0;
  const std::function<bool(int)>& accept;
  std::vector<std::pair<double, int>> found;  // squared distance and index; a heap, worst on top

  bool MayHold(double squared) const {
    return found.size() < count || squared <= found.front().first;
  }
  void Offer(double squared, int index) {
    const std::pair<double, int> item{squared, index};
    if (found.size() == count && !(item < found.front())) return;
    if (!accept(index)) return;
    if (found.size() == count) {
      std::pop_heap(found.begin(), found.end());
      found.pop_back();
    }
    found.push_back(item);
    std::push_heap(found.begin(), found.end());
  }
};

NearestPoints::NearestPoints(std::vector<Vector3d> points)
    : points_(std::move(points)), order_(points_.size()), axis_(points_.size()) {
  std::iota(order_.begin(), order_.end(), 0);
  Split(0, points_.size());
}

void NearestPoints::Split(size_t first, size_t last) {
  if (last - first < 2) return;
  Vector3d low = points_[order_[first]];
  Vector3d high = low;
  for (size_t k = first; k < last; ++k) {
    low = low.cwiseMin(points_[order_[k]]);
    high = high.cwiseMax(points_[order_[k]]);
  }
  int axis = 0;
  (high - low).maxCoeff(&axis);
  const size_t middle = first + (last - first) / 2;
  std::nth_element(order_.begin() + first, order_.begin() + middle, order_.begin() + last,
                   [&](int i, int j) {
                     const double a = points_[i][axis];
                     const double b = points_[j][axis];
                     return a != b ? a < b : i < j;
                   });
  axis_[middle] = axis;
  Split(first, middle);
  Split(middle + 1, last);
}

void NearestPoints::Visit(Search& search, size_t first, size_t last) const {
  if (first >= last) return;
  const size_t middle = first + (last - first) / 2;
  const int index = order_[middle];
  search.Offer((points_[index] - search.position).squaredNorm(), index);
  if (last - first == 1) return;
  const double offset = search.position[axis_[middle]] - points_[index][axis_[middle]];
  const bool low_first = offset < 0;
  low_first ? Visit(search, first, middle) : Visit(search, middle + 1, last);
  if (!search.MayHold(offset * offset)) return;
  low_first ? Visit(search, middle + 1, last) : Visit(search, first, middle);
}

std::vector<int> NearestPoints::Find(const Vector3d& position, size_t count,
                                     const std::function<bool(int)>& accept) const {
  Search search{position, count, accept, {}};
  if (count > 0) Visit(search, 0, points_.size());
  std::sort_heap(search.found.begin(), search.found.end());
  std::vector<int> indices;
  for (const auto& [squared, index] : search.found) indices.push_back(index);
  return indices;
}

}  // namespace stucco::plan
