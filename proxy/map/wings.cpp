// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/map/wings.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <tuple>

namespace stucco {
namespace {

constexpr double kTouch_m = 0.05;  // floors are known to millimetres, outlines to some more

// The place on the nearest edge of the house, its corners first; the place itself where none is
// near.
Eigen::Vector2d Snapped(const FittedBuilding& house, const Eigen::Vector2d& p) {
  for (const FittedEdge& edge : house.edges) {
    if ((edge.line.a - p).norm() < kTouch_m) return edge.line.a;
  }
  double nearest = kTouch_m;
  Eigen::Vector2d on_edge = p;
  for (const FittedEdge& edge : house.edges) {
    const double distance = Distance(edge.line, p);
    if (distance >= nearest) continue;
    nearest = distance;
    const Eigen::Vector2d along = (edge.line.b - edge.line.a).normalized();
    on_edge = edge.line.a + along * along.dot(p - edge.line.a);
  }
  return on_edge;
}

std::vector<Polygon> SnappedParts(const FittedBuilding& house, const FittedBuilding& wing) {
  std::vector<Polygon> parts = wing.building.parts;
  for (Polygon& part : parts) {
    for (Ring& ring : part.rings) {
      for (Eigen::Vector2d& p : ring) p = Snapped(house, p);
    }
  }
  return parts;
}

// How much of two edges is the same line, seen from both its sides.
double SharedLength(const Segment2d& edge, const Segment2d& other) {
  constexpr double kSameLine_m = 1e-6;
  const double length = (edge.b - edge.a).norm();
  if (!(length > 0)) return 0;
  const Eigen::Vector2d along = (edge.b - edge.a) / length;
  if (along.dot(other.b - other.a) >= 0) return 0;
  for (const Eigen::Vector2d& p : {other.a, other.b}) {
    if (std::abs(Cross(along, p - edge.a)) > kSameLine_m) return 0;
  }
  const double from = std::max(0.0, along.dot(other.b - edge.a));
  const double to = std::min(length, along.dot(other.a - edge.a));
  return std::max(0.0, to - from);
}

}  // namespace

double ContactOf(const FittedBuilding& house, const FittedBuilding& wing) {
  double contact = 0;
  for (const Polygon& part : SnappedParts(house, wing)) {
    for (const Ring& ring : part.rings) {
      for (size_t i = 0; i < ring.size(); ++i) {
        const Segment2d edge{ring[i], ring[(i + 1) % ring.size()]};
        for (const FittedEdge& other : house.edges) contact += SharedLength(edge, other.line);
      }
    }
  }
  return contact;
}

FittedBuilding WithWing(FittedBuilding house, const FittedBuilding& wing) {
  assert(ContactOf(house, wing) > 0);
  size_t edge = 0;
  for (Polygon& part : SnappedParts(house, wing)) {
    for (const Ring& ring : part.rings) {
      for (size_t i = 0; i < ring.size(); ++i, ++edge) {
        FittedEdge& added = house.edges.emplace_back(wing.edges[edge]);
        added.line = {ring[i], ring[(i + 1) % ring.size()]};
      }
    }
    house.building.parts.push_back(std::move(part));
  }
  house.ground = std::min(house.ground, wing.ground);
  return house;
}

bool IsWingOf(const FittedBuilding& house, const FittedBuilding& wing) {
  constexpr double kLeastContact_m = 2;
  if (!(Area(wing.building) < Area(house.building))) return false;
  const auto parts = SnappedParts(house, wing);
  return std::ranges::all_of(parts, IsSimple) && ContactOf(house, wing) >= kLeastContact_m;
}

}  // namespace stucco
