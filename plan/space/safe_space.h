// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "plan/space/corners.h"
#include "plan/space/obstacles.h"

namespace stucco::plan {

struct Route {
  std::vector<Eigen::Vector3d> points;  // from start to end, straight lines between
  double length_m = 0;
};

// Shortest paths between free positions of a site. Safe space is the air above the floor without
// the dilated footprints, each up to where it is blocked, and without the no-fly polygons.
//
// The shortest path around prisms in space has no closed form; the best of three families is taken,
// each shortest in itself:
// - around all that is blocked at the height of the lower end,
// - around what is blocked at the height of the higher end, and over the rest,
// - over all footprints, around no-fly polygons only.
// Ways on the map are found by A* on the visibility graph of dilated corners (tangents only),
// within the ellipse that the best length so far allows; visibility is tested when an edge is about
// to be used, against the true dilation. Arcs are polygons around the true ones, which makes a way
// around a right-angled corner at most 0.6 % of its arc longer. Between positions with more than
// 2000 corners in that ellipse (hundreds of metres apart) only the third family is looked at. Any
// number of threads may ask.
class SafeSpace {
 public:
  // Keeps a reference to the obstacles.
  explicit SafeSpace(const Obstacles& obstacles);

  // Nothing where an end is not free, or where no-fly polygons leave no way.
  std::optional<Route> ShortestRoute(const Eigen::Vector3d& p, const Eigen::Vector3d& q) const;
  // The length of that route, infinite where there is none.
  double Distance(const Eigen::Vector3d& p, const Eigen::Vector3d& q) const;

  const Obstacles& obstacles() const { return *obstacles_; }

 private:
  struct Node {
    Corner corner;
    Interval levels;  // the corner bends paths at heights in [from, to)
  };
  struct Query;

  void AddCorners(const Polygon& outline, double radius, double step_rad, double top_m);
  // The shortest way on the map around what is higher than `level_m`, if shorter than `bound_m`.
  std::optional<std::vector<Eigen::Vector2d>> FindTrack(const Query& query) const;
  static bool IsTooMuch(size_t nodes, const Query& query);
  std::vector<int> NodesWithin(const Query& query) const;
  bool IsClear(const Eigen::Vector2d& a, const Eigen::Vector2d& b, double level_m) const;

  const Obstacles* obstacles_;
  std::vector<Node> nodes_;
  BoxTree tree_;  // of the nodes' positions
};

}  // namespace stucco::plan
