// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "survey/intervals.h"

namespace stucco::plan {

// A wall of the map from a to b, seen from its right side only.
struct Wall {
  Eigen::Vector2d a = Eigen::Vector2d::Zero();
  Eigen::Vector2d b = Eigen::Vector2d::Zero();
  int facade = -1;  // -1: it only blocks the view
};

// The parts of one facade that are in sight, in metres from its a.
struct SeenFacade {
  int facade = 0;
  Intervals seen;
};

// What can be seen on a map of walls that do not cross each other. Thread-safe.
class Visibility {
 public:
  explicit Visibility(std::vector<Wall> walls);

  // The facades in sight of `p` with the parts that are not hidden by other walls and not farther
  // away than `radius_m`, by facade. Walls are looked at from outside: `p` must not be inside a
  // building. Angular sweep over the walls nearby in O(n log n) (Asano, "An efficient algorithm for
  // finding the visibility polygon for a polygonal region with holes", 1985), ordered by exact
  // predicates; the ends of the parts have the accuracy of a double.
  std::vector<SeenFacade> From(const Eigen::Vector2d& p, double radius_m) const;

  // Distance from `p` along the unit vector `direction` to the first wall that faces it, at most
  // `reach_m`.
  double FirstHit(const Eigen::Vector2d& p, const Eigen::Vector2d& direction, double reach_m) const;

 private:
  // Walls whose bounding boxes come within `radius_m` of p.
  std::vector<int> Near(const Eigen::Vector2d& p, double radius_m) const;

  std::vector<Wall> walls_;
  // Walls by the cell of their middle; `reach_m_` is the longest half of a wall.
  Eigen::Vector2d corner_ = Eigen::Vector2d::Zero();
  double cell_m_ = 1;
  double reach_m_ = 0;
  int columns_ = 1;
  int rows_ = 1;
  std::vector<int> cell_begin_;  // into cell_walls_, one more than cells
  std::vector<int> cell_walls_;
};

}  // namespace stucco::plan
