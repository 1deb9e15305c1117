// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/polygons.h"

#include <algorithm>
#include <limits>

namespace stucco::plan {
namespace {

// visit(a, b) for every edge.
template <class Visit>
void VisitEdges(const Polygon& polygon, const Visit& visit) {
  for (const Ring& ring : polygon.rings) {
    for (size_t i = 0; i < ring.size(); ++i) visit(ring[i], ring[(i + 1) % ring.size()]);
  }
}

double Cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

}  // namespace

// Relative to the first corner: far from the origin the products would lose digits.
double SignedArea(const Ring& ring) {
  double twice = 0;
  for (size_t i = 2; i < ring.size(); ++i) {
    twice += Cross(ring[i - 1] - ring[0], ring[i] - ring[0]);
  }
  return twice / 2;
}

double Area(const Polygon& polygon) {
  double area = 0;
  for (const Ring& ring : polygon.rings) area += SignedArea(ring);
  return area;
}

Eigen::AlignedBox2d BoundsOf(const Polygon& polygon) {
  Eigen::AlignedBox2d bounds;
  if (polygon.rings.empty()) return bounds;
  for (const Eigen::Vector2d& corner : polygon.rings[0]) bounds.extend(corner);
  return bounds;
}

bool Contains(const Polygon& polygon, const Eigen::Vector2d& p) {
  bool inside = false;
  VisitEdges(polygon, [&](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    if ((a.y() > p.y()) == (b.y() > p.y())) return;
    const bool left_of_upward_edge = Cross(b - a, p - a) > 0;
    if (left_of_upward_edge == (b.y() > a.y())) inside = !inside;
  });
  return inside;
}

double DistanceToSegment(const Eigen::Vector2d& p, const Eigen::Vector2d& a,
                         const Eigen::Vector2d& b) {
  const Eigen::Vector2d along = b - a;
  const double squared = along.squaredNorm();
  const double t = squared > 0 ? std::clamp((p - a).dot(along) / squared, 0.0, 1.0) : 0;
  return (p - a - t * along).norm();
}

double Distance(const Polygon& polygon, const Eigen::Vector2d& p) {
  if (Contains(polygon, p)) return 0;
  double nearest = std::numeric_limits<double>::infinity();
  VisitEdges(polygon, [&](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    nearest = std::min(nearest, DistanceToSegment(p, a, b));
  });
  return nearest;
}

}  // namespace stucco::plan
