// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "plan/site.h"
#include "plan/space/box_tree.h"

namespace stucco::plan {

// A straight flight over or past a prism: from..to (0..1 along it) it is too near to the outline.
struct Crossing {
  Interval part;
  double top_m = 0;
};

// Upright prisms that reach from below everything up to a top each, indexed by their edges.
// Queries allocate nothing and may run on any number of threads.
class Prisms {
 public:
  void Add(const Polygon& outline, double top_m);
  // After the last Add.
  void Index();

  // True when the part of the segment below the top of some prism comes nearer than `radius` to
  // its outline, or lies inside.
  bool Touches(const Eigen::Vector3d& p, const Eigen::Vector3d& q, double radius) const;

  // Horizontal distance to the nearest outline among prisms higher than z, 0 inside; infinite where
  // there is none.
  double Distance(const Eigen::Vector2d& position, double z) const;

  // The highest top among prisms nearer than `radius` to a position; minus infinity without any.
  double TopWithin(const Eigen::Vector2d& position, double radius) const;

  // The prisms higher than `above_m` that the segment crosses or passes nearer than `radius`, each
  // with one interval that holds all its parts there.
  void FindCrossings(const Segment2d& segment, double above_m, double radius,
                     std::vector<Crossing>& crossings) const;

  bool empty() const { return prisms_.empty(); }

 private:
  struct Prism {
    std::vector<Segment2d> edges;
    BoxTree tree;
    double top_m = 0;

    bool Contains(const Eigen::Vector2d& position) const;
    bool IsNear(const Segment2d& segment, double radius) const;
  };

  std::vector<Prism> prisms_;
  BoxTree tree_;
};

}  // namespace stucco::plan
