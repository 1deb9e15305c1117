// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

namespace stucco::plan {

// Points in space by nearness: a balanced k-d tree (Bentley, "Multidimensional binary search trees
// used for associative searching", 1975). Boost's r-tree leaves open which of equally near points a
// query returns, and hovers of a grid have many of those.
class NearestPoints {
 public:
  explicit NearestPoints(std::vector<Eigen::Vector3d> points);

  // The `count` nearest points that `accept` takes, nearest first; ties by index.
  std::vector<int> Find(const Eigen::Vector3d& position, size_t count,
                        const std::function<bool(int)>& accept) const;

 private:
  void Split(size_t first, size_t last);
  struct Search;
  void Visit(Search& search, size_t first, size_t last) const;

  std::vector<Eigen::Vector3d> points_;
  std::vector<int> order_;  // the middle of each range splits it
  std::vector<int> axis_;   // of the split, by place in order_
};

}  // namespace stucco::plan
