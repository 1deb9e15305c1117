// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "simulate/random.h"
#include "survey/geometry2d.h"

namespace stucco::simulate {

// Outlines around the origin, x east, y north: the outer ring counter-clockwise, holes clockwise,
// no corner on a straight wall. Sizes in metres.
Polygon Rectangle(double width, double depth);
// Wings of one width along the south and the west side.
Polygon LShape(double width, double depth, double wing);
// Open to the north.
Polygon UShape(double width, double depth, double wing);
// A bar along the south with a wing to the north in its middle.
Polygon TShape(double width, double depth, double wing);
// Closed around a courtyard.
Polygon CourtyardShape(double width, double depth, double wing);
// A rectangle without its four corners: the usual residential tower.
Polygon CrossShape(double width, double depth, double notch);

// Turned by `radians` counter-clockwise, then moved.
Polygon Placed(Polygon polygon, double radians, const Eigen::Vector2d& position);
// Mirrored in x; the rings keep their senses.
Polygon Mirrored(Polygon polygon);

// A wall of an outline, which is its right side. Corners and edges are counted over the rings: edge
// i starts at corner i.
struct OutlineEdge {
  Eigen::Vector2d a = Eigen::Vector2d::Zero();
  Eigen::Vector2d b = Eigen::Vector2d::Zero();
  int before = 0;  // its neighbours in the ring
  int after = 0;

  Eigen::Vector2d along() const { return (b - a).normalized(); }
  Eigen::Vector2d outward() const {
    const Eigen::Vector2d u = along();
    return {u.y(), -u.x()};
  }
};
std::vector<OutlineEdge> EdgesOf(const Polygon& outline);

// The smallest distance between a point, inside or outside, and the outline.
double DistanceToOutline(const Polygon& polygon, const Eigen::Vector2d& point);
// The smallest distance between two outlines, negative where their interiors meet by more than a
// millimetre; walls in common count as distance zero.
double Gap(const Polygon& a, const Polygon& b);

// Every edge moved to its right by its own distance (outwards for positive ones), corners where the
// moved edges meet.
Ring Offset(const Ring& ring, const std::vector<double>& distances);

}  // namespace stucco::simulate
