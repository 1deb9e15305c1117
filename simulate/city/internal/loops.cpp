// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulate/city/internal/loops.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "plan/polygons.h"
#include "plan/space/plane.h"

namespace stucco::simulate::internal {
namespace {

using Eigen::Vector2d;
using Key = std::pair<int64_t, int64_t>;

Key KeyOf(const Vector2d& point) {
  constexpr double kPerMetre = 1000;
  return {std::llround(point.x() * kPerMetre), std::llround(point.y() * kPerMetre)};
}

// Edges of all rings by their start, less those that are there in both directions.
std::multimap<Key, Key> FreeEdges(const std::vector<plan::Ring>& rings,
                                  std::map<Key, Vector2d>& points) {
  std::multimap<Key, Key> edges;
  for (const plan::Ring& ring : rings) {
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

plan::Ring WithoutStraightCorners(const plan::Ring& ring) {
  plan::Ring kept;
  const size_t n = ring.size();
  for (size_t i = 0; i < n; ++i) {
    const Vector2d u = (ring[i] - ring[(i + n - 1) % n]).normalized();
    const Vector2d v = (ring[(i + 1) % n] - ring[i]).normalized();
    constexpr double kStraight = 1e-6;
    if (std::abs(plan::Cross(u, v)) > kStraight) kept.push_back(ring[i]);
  }
  return kept;
}

}  // namespace

std::vector<plan::Ring> JoinLoops(const std::vector<plan::Ring>& rings) {
  std::map<Key, Vector2d> points;
  std::multimap<Key, Key> edges = FreeEdges(rings, points);
  std::vector<plan::Ring> loops;
  while (!edges.empty()) {
    plan::Ring loop;
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
        const double turn = std::atan2(plan::Cross(heading, ahead), heading.dot(ahead));
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

std::vector<plan::Polygon> PolygonsOf(const std::vector<plan::Ring>& loops) {
  std::vector<plan::Polygon> polygons;
  for (const plan::Ring& loop : loops) {
    if (plan::SignedArea(loop) > 0) polygons.push_back({{loop}});
  }
  std::stable_sort(polygons.begin(), polygons.end(), [](const auto& a, const auto& b) {
    return plan::SignedArea(a.rings[0]) < plan::SignedArea(b.rings[0]);
  });
  for (const plan::Ring& loop : loops) {
    if (plan::SignedArea(loop) > 0) continue;
    for (plan::Polygon& polygon : polygons) {
      if (plan::SignedArea(polygon.rings[0]) <= -plan::SignedArea(loop)) continue;
      if (!plan::Contains({{polygon.rings[0]}}, loop[0])) continue;
      polygon.rings.push_back(loop);
      break;
    }
  }
  return polygons;
}

}  // namespace stucco::simulate::internal
