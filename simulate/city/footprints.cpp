// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulate/city/footprints.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "survey/geometry2d.h"

namespace stucco::simulate {
namespace {

using Eigen::Vector2d;

Polygon Centred(Ring ring, double width, double depth) {
  for (Vector2d& corner : ring) corner -= Vector2d(width / 2, depth / 2);
  return {{std::move(ring)}};
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

// Whether a point of `a` just inside one of its walls lies inside `b`.
bool ReachesInto(const Polygon& a, const Polygon& b) {
  constexpr double kInside_m = 2e-3;
  const std::vector<OutlineEdge> edges = EdgesOf(a);
  return std::any_of(edges.begin(), edges.end(), [&](const OutlineEdge& edge) {
    const Vector2d inside = (edge.a + edge.b) / 2 - kInside_m * edge.outward();
    return Contains(b, inside) && DistanceToOutline(b, inside) > kInside_m / 2;
  });
}

}  // namespace

Polygon Rectangle(double width, double depth) {
  return Centred({{0, 0}, {width, 0}, {width, depth}, {0, depth}}, width, depth);
}

Polygon LShape(double width, double depth, double wing) {
  return Centred({{0, 0}, {width, 0}, {width, wing}, {wing, wing}, {wing, depth}, {0, depth}},
                 width, depth);
}

Polygon UShape(double width, double depth, double wing) {
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

Polygon TShape(double width, double depth, double wing) {
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

Polygon CourtyardShape(double width, double depth, double wing) {
  Polygon polygon = Rectangle(width, depth);
  Ring hole = Rectangle(width - 2 * wing, depth - 2 * wing).rings[0];
  std::reverse(hole.begin(), hole.end());
  polygon.rings.push_back(std::move(hole));
  return polygon;
}

Polygon CrossShape(double width, double depth, double notch) {
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

Polygon Placed(Polygon polygon, double radians, const Vector2d& position) {
  const Eigen::Rotation2Dd turn(radians);
  for (Ring& ring : polygon.rings) {
    for (Vector2d& corner : ring) corner = turn * corner + position;
  }
  return polygon;
}

Polygon Mirrored(Polygon polygon) {
  for (Ring& ring : polygon.rings) {
    for (Vector2d& corner : ring) corner.x() = -corner.x();
    std::reverse(ring.begin(), ring.end());
  }
  return polygon;
}

std::vector<OutlineEdge> EdgesOf(const Polygon& outline) {
  std::vector<OutlineEdge> edges;
  for (const Ring& ring : outline.rings) {
    const int start = static_cast<int>(edges.size());
    const int n = static_cast<int>(ring.size());
    for (int i = 0; i < n; ++i) {
      edges.push_back({ring[i], ring[(i + 1) % n], start + (i + n - 1) % n, start + (i + 1) % n});
    }
  }
  return edges;
}

double DistanceToOutline(const Polygon& polygon, const Vector2d& point) {
  double least = std::numeric_limits<double>::infinity();
  for (const OutlineEdge& edge : EdgesOf(polygon)) {
    least = std::min(least, Distance(Segment2d{edge.a, edge.b}, point));
  }
  return least;
}

double Gap(const Polygon& a, const Polygon& b) {
  if (ReachesInto(a, b) || ReachesInto(b, a)) return -1;
  const std::vector<OutlineEdge> theirs = EdgesOf(b);
  double least = std::numeric_limits<double>::infinity();
  for (const OutlineEdge& edge : EdgesOf(a)) {
    for (const OutlineEdge& other : theirs) {
      if (SegmentsCross(edge.a, edge.b, other.a, other.b)) return -1;
      least = std::min({least, Distance(Segment2d{other.a, other.b}, edge.a),
                        Distance(Segment2d{edge.a, edge.b}, other.a)});
    }
  }
  return least;
}

Ring Offset(const Ring& ring, const std::vector<double>& distances) {
  const size_t n = ring.size();
  Ring moved;
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
