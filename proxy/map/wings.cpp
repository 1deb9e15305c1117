// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/map/wings.h"

#include <algorithm>
#include <cassert>
#include <utility>
#include <vector>

#include "proxy/map/move_edges.h"
#include "proxy/map/shared_length.h"

namespace stucco {
namespace {

constexpr double kTouching_m = 1e-6;
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

}  // namespace

double ContactOf(const FittedBuilding& house, const FittedBuilding& wing) {
  double contact = 0;
  const auto add = [&](const Segment2d& edge) {
    for (const FittedEdge& other : house.edges) {
      contact += SharedLength(edge, other.line, kTouching_m, Heading::kOpposite);
    }
  };
  for (const Polygon& part : SnappedParts(house, wing)) {
    for (const Ring& ring : part.rings) {
      for (size_t i = 0; i < ring.size(); ++i) add(EdgeOf(ring, i));
    }
  }
  return contact;
}

FittedBuilding WithWing(FittedBuilding house, const FittedBuilding& wing) {
  assert(ContactOf(house, wing) > 0);
  std::vector<Polygon> parts = house.building.parts;
  for (Polygon& part : SnappedParts(house, wing)) parts.push_back(std::move(part));
  house.edges.insert(house.edges.end(), wing.edges.begin(), wing.edges.end());
  house.ground = std::min(house.ground, wing.ground);
  return WithParts(std::move(house), std::move(parts));
}

bool IsWingOf(const FittedBuilding& house, const FittedBuilding& wing) {
  constexpr double kLeastContact_m = 2;
  if (!(Area(wing.building) < Area(house.building))) return false;
  const auto parts = SnappedParts(house, wing);
  return std::ranges::all_of(parts, IsSimple) && ContactOf(house, wing) >= kLeastContact_m;
}

}  // namespace stucco
