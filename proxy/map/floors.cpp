// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/map/floors.h"

#include <algorithm>

namespace stucco {

Polygon InGroundPlan(const Facet& facet, const Eigen::Matrix3d& upright_from_world) {
  Polygon polygon;
  const auto add = [&](const std::vector<Eigen::Vector3d>& corners) {
    Ring& ring = polygon.rings.emplace_back();
    for (const auto& p : corners) ring.push_back((upright_from_world * p).head<2>());
  };
  add(facet.outer);
  for (const auto& hole : facet.holes) add(hole);
  return polygon;
}

namespace {

// The facets of closed buildings that look down, of which `is_one` says so.
template <typename IsOne>
std::vector<Polygon> FromBelow(std::span<const Building> buildings,
                               const Eigen::Matrix3d& upright_from_world, const IsOne& is_one) {
  std::vector<Polygon> floors;
  for (const Building& building : buildings) {
    for (const Facet& facet : building.facets) {
      if (!building.watertight || !is_one(facet)) continue;
      Polygon& floor = floors.emplace_back(InGroundPlan(facet, upright_from_world));
      for (Ring& ring : floor.rings) std::ranges::reverse(ring);
    }
  }
  return floors;
}

}  // namespace

std::vector<Polygon> FloorsOf(std::span<const Building> buildings,
                              const Eigen::Matrix3d& upright_from_world) {
  return FromBelow(buildings, upright_from_world,
                   [](const Facet& facet) { return facet.facet_class == FacetClass::kGround; });
}

std::vector<Polygon> FootprintsOf(std::span<const Building> buildings,
                                  const Eigen::Matrix3d& upright_from_world) {
  return FromBelow(buildings, upright_from_world, [&](const Facet& facet) {
    const bool hangs =
        facet.facet_class == FacetClass::kOuterFloor && (upright_from_world * facet.normal).z() < 0;
    return hangs || facet.facet_class == FacetClass::kGround;
  });
}

}  // namespace stucco
