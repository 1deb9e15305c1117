// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <vector>

namespace stucco {

// The plane: outlines, straight lines between points, and what they enclose. Lengths are in the
// unit of the coordinates.

// Corners in order, the first not repeated.
using Ring = std::vector<Eigen::Vector2d>;
struct Polygon {
  std::vector<Ring> rings;  // outer counter-clockwise, then holes clockwise
};

struct Segment2d {
  Eigen::Vector2d a = Eigen::Vector2d::Zero();
  Eigen::Vector2d b = Eigen::Vector2d::Zero();
};

// The z of the cross product: positive when v is to the left of u.
inline double Cross(const Eigen::Vector2d& u, const Eigen::Vector2d& v) {
  return u.x() * v.y() - u.y() * v.x();
}

// Of length 1, to the right: outwards where the edge is one of a counter-clockwise ring. Zero
// length, 0.
inline Eigen::Vector2d OutwardsOf(const Segment2d& edge) {
  const Eigen::Vector2d along = (edge.b - edge.a).normalized();
  return {along.y(), -along.x()};
}

// A turn about `center`, then a shift: rigid, by small steps of least squares.
struct LevelMotion {
  Eigen::Vector2d center = Eigen::Vector2d::Zero();
  Eigen::Vector2d shift = Eigen::Vector2d::Zero();
  double turn_rad = 0;  // counter-clockwise

  Eigen::Isometry2d Transform() const;
  // By how much a place that it has moved goes along `n` for a shift by one along x and y, and for
  // a turn by one radian.
  Eigen::Vector3d RowOf(const Eigen::Vector2d& n, const Eigen::Vector2d& moved) const;
};

double SignedArea(const Ring& ring);  // positive when counter-clockwise
double Area(const Polygon& polygon);
// Rings one after the other, holes (clockwise) behind the outer ring that they are in.
std::vector<Polygon> PolygonsOf(const std::vector<Ring>& rings);
// Of the outer ring; empty without one.
Eigen::AlignedBox2d BoundsOf(const Polygon& polygon);
// By crossings: points on the boundary may count either way.
bool Contains(const Polygon& polygon, const Eigen::Vector2d& p);
bool Contains(const Ring& ring, const Eigen::Vector2d& p);

// To the nearest point of the segment, which may have no length. The squares spare a square root to
// whoever only compares.
double Distance(const Segment2d& segment, const Eigen::Vector2d& p);
double SquaredDistance(const Segment2d& segment, const Eigen::Vector2d& p);
double SquaredDistance(const Segment2d& s, const Segment2d& t);  // 0 where they cross or touch
// 0 inside; infinite without a ring.
double Distance(const Polygon& polygon, const Eigen::Vector2d& p);

}  // namespace stucco
