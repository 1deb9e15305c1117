// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulate/city/internal/loops.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "survey/geometry2d.h"

namespace stucco::simulate::internal {
namespace {

using Eigen::Vector2d;
using Key = std::pair<int64_t, int64_t>;

Key KeyOf(const Vector2d& point) {
  constexpr double kPerMetre = 1000;
  return {std::llround(point.x() * kPerMetre), std::llround(point.y() * kPerMetre)};
}

// Edges of all rings by their start, less those that are there in both directions.
std::multimap<Key, Key> FreeEdges(const std::vector<Ring>& rings, std::map<Key, Vector2d>& points) {
  std::multimap<Key, Key> edges;
  for (const Ring& ring : rings) {
    for (size_t i = 0; i < ring.size(); ++i) {
      const Key a = KeyOf(ring[i]);
      const Key b = KeyOf(ring[(i + 1) % ring.size()]);
      points.emplace(a, ring[i]);
      const auto [from, to] = edges.equal_range(b);
      const auto back = std::find_if(from, to, [&](const auto& edge) { return edge.second == a; });
      if (back != to) {
        edges.erase(back);
      } else {
        edges.emplace(a, b);
      }
    }
  }
  return edges;
}

Ring WithoutStraightCorners(const Ring& ring) {
  Ring kept;
  const size_t n = ring.size();
  for (size_t i = 0; i < n; ++i) {
    const Vector2d u = (ring[i] - ring[(i + n - 1) % n]).normalized();
    const Vector2d v = (ring[(i + 1) % n] - ring[i]).normalized();
    constexpr double kStraight = 1e-6;
    if (std::abs(Cross(u, v)) > kStraight) kept.push_back(ring[i]);
  }
  return kept;
}

}  // namespace

std::vector<Ring> JoinLoops(const std::vector<Ring>& rings) {
  std::map<Key, Vector2d> points;
  std::multimap<Key, Key> edges = FreeEdges(rings, points);
  std::vector<Ring> loops;
  while (!edges.empty()) {
    Ring loop;
    const Key start = edges.begin()->first;
    Key at = start;
    Vector2d heading = Vector2d::Zero();
    do {
      loop.push_back(points.at(at));
      // Where loops touch in a corner, turning left most keeps them apart.
      const auto [from, to] = edges.equal_range(at);
      if (from == to) break;
      auto best = from;
      double most = -4;
      for (auto edge = from; edge != to; ++edge) {
        const Vector2d ahead = points.at(edge->second) - points.at(at);
        const double turn = std::atan2(Cross(heading, ahead), heading.dot(ahead));
        if (turn <= most) continue;
        most = turn;
        best = edge;
      }
      heading = points.at(best->second) - points.at(at);
      at = best->second;
      edges.erase(best);
    } while (at != start);
    loop = WithoutStraightCorners(loop);
    if (loop.size() > 2) loops.push_back(std::move(loop));
  }
  return loops;
}

std::vector<Polygon> PolygonsOf(const std::vector<Ring>& loops) {
  std::vector<Polygon> polygons;
  for (const Ring& loop : loops) {
    if (SignedArea(loop) > 0) polygons.push_back({{loop}});
  }
  std::stable_sort(polygons.begin(), polygons.end(), [](const auto& a, const auto& b) {
    return SignedArea(a.rings[0]) < SignedArea(b.rings[0]);
  });
  for (const Ring& loop : loops) {
    if (SignedArea(loop) > 0) continue;
    for (Polygon& polygon : polygons) {
      if (SignedArea(polygon.rings[0]) <= -SignedArea(loop)) continue;
      if (!Contains(polygon.rings[0], loop[0])) continue;
      polygon.rings.push_back(loop);
      break;
    }
  }
  return polygons;
}

}  // namespace stucco::simulate::internal
