// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/geometry2d.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace stucco {
namespace {

// visit(a, b) for every edge.
template <class Visit>
void VisitEdges(const Ring& ring, const Visit& visit) {
  for (size_t i = 0; i < ring.size(); ++i) visit(ring[i], ring[(i + 1) % ring.size()]);
}

template <class Visit>
void VisitEdges(const Polygon& polygon, const Visit& visit) {
  for (const Ring& ring : polygon.rings) VisitEdges(ring, visit);
}

// By crossings; `outline` is a ring or a polygon.
template <class Outline>
bool Encloses(const Outline& outline, const Eigen::Vector2d& p) {
  bool inside = false;
  VisitEdges(outline, [&](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    if ((a.y() > p.y()) == (b.y() > p.y())) return;
    const bool left_of_upward_edge = Cross(b - a, p - a) > 0;
    if (left_of_upward_edge == (b.y() > a.y())) inside = !inside;
  });
  return inside;
}

bool CrossEachOther(const Segment2d& s, const Segment2d& t) {
  const Eigen::Vector2d u = s.b - s.a;
  const Eigen::Vector2d v = t.b - t.a;
  const double from_t_a = Cross(v, s.a - t.a);
  const double from_t_b = Cross(v, s.b - t.a);
  const double from_s_a = Cross(u, t.a - s.a);
  const double from_s_b = Cross(u, t.b - s.a);
  return (from_t_a > 0) != (from_t_b > 0) && (from_s_a > 0) != (from_s_b > 0);
}

}  // namespace

// Relative to the first corner: far from the origin the products would lose digits.
Eigen::Isometry2d LevelMotion::Transform() const {
  Eigen::Isometry2d result = Eigen::Isometry2d::Identity();
  result.linear() = Eigen::Rotation2Dd(turn_rad).toRotationMatrix();
  result.translation() = center + shift - result.linear() * center;
  return result;
}

Eigen::Vector3d LevelMotion::RowOf(const Eigen::Vector2d& n, const Eigen::Vector2d& moved) const {
  const Eigen::Vector2d arm = moved - center - shift;
  return {n.x(), n.y(), n.y() * arm.x() - n.x() * arm.y()};
}

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

std::vector<Polygon> PolygonsOf(const std::vector<Ring>& rings) {
  std::vector<Polygon> polygons;
  for (const Ring& ring : rings) {
    if (polygons.empty() || SignedArea(ring) > 0) polygons.emplace_back();
    polygons.back().rings.push_back(ring);
  }
  return polygons;
}

Eigen::AlignedBox2d BoundsOf(const Polygon& polygon) {
  Eigen::AlignedBox2d bounds;
  if (polygon.rings.empty()) return bounds;
  for (const Eigen::Vector2d& corner : polygon.rings[0]) bounds.extend(corner);
  return bounds;
}

bool Contains(const Polygon& polygon, const Eigen::Vector2d& p) {
  return Encloses(polygon, p);
}

bool Contains(const Ring& ring, const Eigen::Vector2d& p) {
  return Encloses(ring, p);
}

double SquaredDistance(const Segment2d& segment, const Eigen::Vector2d& p) {
  const Eigen::Vector2d along = segment.b - segment.a;
  const double squared = along.squaredNorm();
  const double t = squared > 0 ? std::clamp((p - segment.a).dot(along) / squared, 0.0, 1.0) : 0;
  return (segment.a + t * along - p).squaredNorm();
}

double Distance(const Segment2d& segment, const Eigen::Vector2d& p) {
  return std::sqrt(SquaredDistance(segment, p));
}

double SquaredDistance(const Segment2d& s, const Segment2d& t) {
  if (CrossEachOther(s, t)) return 0;
  return std::min({SquaredDistance(t, s.a), SquaredDistance(t, s.b), SquaredDistance(s, t.a),
                   SquaredDistance(s, t.b)});
}

double Distance(const Polygon& polygon, const Eigen::Vector2d& p) {
  if (Contains(polygon, p)) return 0;
  double nearest = std::numeric_limits<double>::infinity();
  VisitEdges(polygon, [&](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    nearest = std::min(nearest, Distance(Segment2d{a, b}, p));
  });
  return nearest;
}

}  // namespace stucco
