// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <span>
#include <utility>
#include <vector>

#include "survey/geometry2d.h"

namespace stucco {

// A line that may bound a facet, in plane coordinates.
struct CutLine {
  Eigen::Vector2d point = Eigen::Vector2d::Zero();
  Eigen::Vector2d direction = Eigen::Vector2d::UnitX();  // unit
  bool crease = false;                                   // intersection with another plane
  bool free = false;  // along neither an axis of the frame nor a crease
  bool foot = false;  // crease of a wall with the ground: below it there is no wall
  // Where along the direction both planes of a crease are seen nearby, so that a border is
  // expected.
  double from = 0;
  double to = 0;

  // Height of a point above the line, v upwards.
  double HeightOf(const Eigen::Vector2d& p) const {
    const Eigen::Vector2d d = p - point;
    const double height = direction.x() * d.y() - direction.y() * d.x();
    return direction.x() < 0 ? -height : height;
  }
  bool IsActiveAt(const Eigen::Vector2d& p) const {
    const double t = direction.dot(p - point);
    return crease && t >= from && t <= to;
  }
};

// A box cut by lines into convex faces that share their vertices.
struct Arrangement {
  std::vector<Eigen::Vector2d> vertices;
  std::vector<std::vector<int>> faces;  // counter-clockwise; straight corners are kept

  struct Edge {
    int left = -1;  // face that has (from, to) in its loop; -1: outside of the box
    int right = -1;
    int from = 0, to = 0;
    int line = -1;  // index of the line it lies on; -1: the box
  };
  std::vector<Edge> edges;  // each once, by (from, to)
};

// Lines may be the same, or nearly: what is within a billionth of the box's size of a line is on
// it.
Arrangement Arrange(const Eigen::AlignedBox2d& box, std::span<const CutLine> lines);

// The corners of a face.
Ring RingOf(const Arrangement& arrangement, size_t face);
// Their mean, which lies in the face: faces of lines are convex.
Eigen::Vector2d InnerPoint(const Arrangement& arrangement, size_t face);

// A simple polygon with holes by vertex numbers: outer ring counter-clockwise, holes clockwise.
struct IndexPolygon {
  std::vector<int> outer;
  std::vector<std::vector<int>> holes;
};

// UnionOf with every vertex along the rings, straight corners too.
std::vector<IndexPolygon> UnionOfIndices(const Arrangement& arrangement,
                                         const std::vector<bool>& inside);

// The union of the faces with `inside`, one polygon for each set connected through edges, without
// straight corners. Rings that would touch themselves in a vertex are split there.
std::vector<Polygon> UnionOf(const Arrangement& arrangement, const std::vector<bool>& inside);

}  // namespace stucco
