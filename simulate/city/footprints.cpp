// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulate/city/footprints.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace stucco::simulate {
namespace {

using Eigen::Vector2d;

double Cross(const Vector2d& a, const Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

plan::Polygon Centred(plan::Ring ring, double width, double depth) {
  for (Vector2d& corner : ring) corner -= Vector2d(width / 2, depth / 2);
  return {{std::move(ring)}};
}

double DistanceToSegment(const Vector2d& point, const Vector2d& a, const Vector2d& b) {
  const Vector2d ab = b - a;
  const double t = std::clamp((point - a).dot(ab) / ab.squaredNorm(), 0.0, 1.0);
  return (a + t * ab - point).norm();
}

bool SegmentsCross(const Vector2d& a, const Vector2d& b, const Vector2d& c, const Vector2d& d) {
  const auto sides = [](const Vector2d& p, const Vector2d& q, const Vector2d& r,
                        const Vector2d& s) {
    constexpr double kTouch_m = 1e-3;
    const Vector2d u = (q - p).normalized();
    const double left = Cross(u, r - p);
    const double right = Cross(u, s - p);
    return (left > kTouch_m && right < -kTouch_m) || (left < -kTouch_m && right > kTouch_m);
  };
  return sides(a, b, c, d) && sides(c, d, a, b);
}

template <typename Visit>
void ForEdges(const plan::Polygon& polygon, const Visit& visit) {
  for (const plan::Ring& ring : polygon.rings) {
    for (size_t i = 0; i < ring.size(); ++i) visit(ring[i], ring[(i + 1) % ring.size()]);
  }
}

// Whether a point of `a` just inside one of its walls lies inside `b`.
bool ReachesInto(const plan::Polygon& a, const plan::Polygon& b) {
  constexpr double kInside_m = 2e-3;
  bool reaches = false;
  ForEdges(a, [&](const Vector2d& p, const Vector2d& q) {
    const Vector2d u = (q - p).normalized();
    const Vector2d inside = (p + q) / 2 + kInside_m * Vector2d(-u.y(), u.x());
    reaches = reaches || (Contains(b, inside) && DistanceToOutline(b, inside) > kInside_m / 2);
  });
  return reaches;
}

}  // namespace

plan::Polygon Rectangle(double width, double depth) {
  return Centred({{0, 0}, {width, 0}, {width, depth}, {0, depth}}, width, depth);
}

plan::Polygon LShape(double width, double depth, double wing) {
  return Centred({{0, 0}, {width, 0}, {width, wing}, {wing, wing}, {wing, depth}, {0, depth}},
                 width, depth);
}

plan::Polygon UShape(double width, double depth, double wing) {
  return Centred({{0, 0},
                  {width, 0},
                  {width, depth},
                  {width - wing, depth},
                  {width - wing, wing},
                  {wing, wing},
                  {wing, depth},
                  {0, depth}},
                 width, depth);
}

plan::Polygon TShape(double width, double depth, double wing) {
  const double left = (width - wing) / 2;
  return Centred({{0, 0},
                  {width, 0},
                  {width, wing},
                  {left + wing, wing},
                  {left + wing, depth},
                  {left, depth},
                  {left, wing},
                  {0, wing}},
                 width, depth);
}

plan::Polygon CourtyardShape(double width, double depth, double wing) {
  plan::Polygon polygon = Rectangle(width, depth);
  plan::Ring hole = Rectangle(width - 2 * wing, depth - 2 * wing).rings[0];
  std::reverse(hole.begin(), hole.end());
  polygon.rings.push_back(std::move(hole));
  return polygon;
}

plan::Polygon CrossShape(double width, double depth, double notch) {
  const double w = width;
  const double d = depth;
  const double n = notch;
  return Centred({{n, 0},
                  {w - n, 0},
                  {w - n, n},
                  {w, n},
                  {w, d - n},
                  {w - n, d - n},
                  {w - n, d},
                  {n, d},
                  {n, d - n},
                  {0, d - n},
                  {0, n},
                  {n, n}},
                 w, d);
}

plan::Polygon Placed(plan::Polygon polygon, double radians, const Vector2d& position) {
  const Eigen::Rotation2Dd turn(radians);
  for (plan::Ring& ring : polygon.rings) {
    for (Vector2d& corner : ring) corner = turn * corner + position;
  }
  return polygon;
}

plan::Polygon Mirrored(plan::Polygon polygon) {
  for (plan::Ring& ring : polygon.rings) {
    for (Vector2d& corner : ring) corner.x() = -corner.x();
    std::reverse(ring.begin(), ring.end());
  }
  return polygon;
}

double AreaOf(const plan::Ring& ring) {
  double twice = 0;
  for (size_t i = 0; i < ring.size(); ++i) twice += Cross(ring[i], ring[(i + 1) % ring.size()]);
  return twice / 2;
}

double AreaOf(const plan::Polygon& polygon) {
  double area = 0;
  for (const plan::Ring& ring : polygon.rings) area += AreaOf(ring);
  return area;
}

bool Contains(const plan::Polygon& polygon, const Vector2d& point) {
  bool inside = false;
  ForEdges(polygon, [&](const Vector2d& a, const Vector2d& b) {
    if ((a.y() > point.y()) == (b.y() > point.y())) return;
    const double x = a.x() + (point.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x());
    if (point.x() < x) inside = !inside;
  });
  return inside;
}

double DistanceToOutline(const plan::Polygon& polygon, const Vector2d& point) {
  double least = std::numeric_limits<double>::infinity();
  ForEdges(polygon, [&](const Vector2d& a, const Vector2d& b) {
    least = std::min(least, DistanceToSegment(point, a, b));
  });
  return least;
}

double Gap(const plan::Polygon& a, const plan::Polygon& b) {
  bool crosses = ReachesInto(a, b) || ReachesInto(b, a);
  double least = std::numeric_limits<double>::infinity();
  ForEdges(a, [&](const Vector2d& p, const Vector2d& q) {
    least = std::min(least, DistanceToOutline(b, p));
    ForEdges(b, [&](const Vector2d& r, const Vector2d& s) {
      least = std::min(least, DistanceToSegment(r, p, q));
      crosses = crosses || SegmentsCross(p, q, r, s);
    });
  });
  return crosses ? -1 : least;
}

plan::Ring Offset(const plan::Ring& ring, const std::vector<double>& distances) {
  const size_t n = ring.size();
  plan::Ring moved;
  for (size_t i = 0; i < n; ++i) {
    const size_t before = (i + n - 1) % n;
    const Vector2d u = (ring[i] - ring[before]).normalized();
    const Vector2d v = (ring[(i + 1) % n] - ring[i]).normalized();
    // The corner moves by the vector whose components along both normals are the distances.
    Eigen::Matrix2d normals;
    normals << u.y(), -u.x(), v.y(), -v.x();
    moved.push_back(ring[i] + normals.inverse() * Vector2d(distances[before], distances[i]));
  }
  return moved;
}

}  // namespace stucco::simulate
