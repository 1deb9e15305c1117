// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "site/box_grid.h"
#include "site/site.h"

namespace stucco::plan::internal {

// Without corners that repeat the one before and without spikes that go out and back the same way.
// Fewer than three corners may be left.
Ring Tidied(const Ring& ring);

// Without corners that are farther than `tolerance_m` from the simplified ring nowhere (Douglas &
// Peucker, "Algorithms for the reduction of the number of points", 1973, from the corner farthest
// to the south-west).
Ring Simplified(const Ring& ring, double tolerance_m);

// Makes neighbours share their corners, so that walls which are meant to be one are one: corners
// within the tolerance of each other become one (the first that came), and edges that pass a corner
// within it go through it. Coordinates are whole millimetres afterwards.
class Noder {
 public:
  explicit Noder(double tolerance_m) : tolerance_m_(tolerance_m) {}

  // Returns whether anything changed.
  bool Apply(std::vector<Polygon>& polygons);

  // Corners moved by more than rounding, so far.
  int moved() const { return moved_; }

 private:
  Eigen::Vector2d Snapped(const Eigen::Vector2d& corner);
  bool SnapCorners(std::vector<Polygon>& polygons);
  bool SplitEdges(std::vector<Polygon>& polygons) const;
  // The corners that the edge from a to b passes, in this order.
  void AddPassed(const Eigen::Vector2d& a, const Eigen::Vector2d& b,
                 std::span<const Eigen::Vector2d> corners, const BoxGrid& grid, Ring& noded) const;

  double tolerance_m_;
  int moved_ = 0;
  std::vector<Eigen::Vector2d> points_;                    // in order of arrival
  std::unordered_map<int64_t, std::vector<int>> by_cell_;  // points by cell of tolerance size
};

}  // namespace stucco::plan::internal
