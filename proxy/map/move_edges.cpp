// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/map/move_edges.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>
#include <vector>

#include "proxy/map/outlines.h"

namespace stucco {
namespace {

// An edge at one of its ends once it has moved.
struct MovedLine {
  Eigen::Vector2d outwards;
  double by = 0;  // outwards, from where the end was
};

MovedLine LineAt(const Segment2d& edge, const EdgeMove& move, double at_corner) {
  const Eigen::Vector2d along = edge.b - edge.a, outwards = OutwardsOf(edge);
  const double slope = (move.at_end - move.at_start) / along.norm();
  const Eigen::Vector2d turned = (outwards - slope * along.normalized()).normalized();
  return {turned, at_corner * outwards.dot(turned)};
}

// Where a corner between two edges goes.
Eigen::Vector2d CornerMove(const MovedLine& before, const MovedLine& after) {
  const auto& [n1, o1] = before;
  const auto& [n2, o2] = after;
  constexpr double kParallel = 0.26;  // sine of 15 degrees
  constexpr double kFarthest = 3;     // times the larger offset: sharp corners run away
  const double cross = Cross(n1, n2);
  Eigen::Vector2d mean = (n1 * o1 + n2 * o2) / 2;
  if (std::abs(cross) < kParallel) return mean;
  Eigen::Vector2d move =
      Eigen::Vector2d(o1 * n2.y() - o2 * n1.y(), n1.x() * o2 - n2.x() * o1) / cross;
  if (move.norm() > kFarthest * std::max(std::abs(o1), std::abs(o2))) move = mean;
  return move;
}

size_t EdgeCount(const Polygon& polygon) {
  size_t edges = 0;
  for (const Ring& ring : polygon.rings) edges += ring.size();
  return edges;
}

}  // namespace

bool IsSimple(const Polygon& polygon) {
  constexpr double kApart_m = 0.01;
  std::vector<Segment2d> edges;
  std::vector<std::pair<size_t, size_t>> place;  // ring, edge
  for (size_t r = 0; r < polygon.rings.size(); ++r) {
    const Ring& ring = polygon.rings[r];
    if (ring.size() < 3 || (SignedArea(ring) > 0) != (r == 0)) return false;
    if (r > 0 && !Contains(polygon.rings[0], ring[0])) return false;
    for (size_t i = 0; i < ring.size(); ++i) {
      edges.push_back(EdgeOf(ring, i));
      place.emplace_back(r, i);
    }
  }
  for (size_t a = 0; a < edges.size(); ++a) {
    if ((edges[a].b - edges[a].a).norm() < kApart_m) return false;
    for (size_t b = a + 1; b < edges.size(); ++b) {
      const size_t n = polygon.rings[place[a].first].size();
      const size_t steps = place[b].second - place[a].second;
      const bool next = place[a].first == place[b].first && (steps == 1 || steps == n - 1);
      if (!next && SquaredDistance(edges[a], edges[b]) < kApart_m * kApart_m) return false;
      if (!next) continue;
      const Segment2d& first = steps == 1 ? edges[a] : edges[b];
      const Segment2d& second = steps == 1 ? edges[b] : edges[a];
      const Eigen::Vector2d u = (first.b - first.a).normalized();
      const Eigen::Vector2d v = (second.b - second.a).normalized();
      if (u.dot(v) < -1 + 1e-6) return false;  // a spike
    }
  }
  return !edges.empty();
}

std::optional<Polygon> WithEdgesMoved(const Polygon& polygon, std::span<const EdgeMove> moves) {
  assert(moves.size() == EdgeCount(polygon));
  Polygon moved = polygon;
  size_t first = 0;
  for (size_t r = 0; r < polygon.rings.size(); ++r) {
    const Ring& ring = polygon.rings[r];
    for (size_t i = 0; i < ring.size(); ++i) {
      const size_t before = (i + ring.size() - 1) % ring.size();
      const EdgeMove &to_here = moves[first + before], &from_here = moves[first + i];
      moved.rings[r][i] += CornerMove(LineAt(EdgeOf(ring, before), to_here, to_here.at_end),
                                      LineAt(EdgeOf(ring, i), from_here, from_here.at_start));
    }
    first += ring.size();
  }
  const double area_before = Area(polygon), area = Area(moved);
  if (!(area > area_before / 2 && area < 2 * area_before) || !IsSimple(moved)) return std::nullopt;
  return moved;
}

}  // namespace stucco
