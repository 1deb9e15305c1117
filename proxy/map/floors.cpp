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

std::vector<Polygon> FloorsOf(std::span<const Building> buildings,
                              const Eigen::Matrix3d& upright_from_world) {
  std::vector<Polygon> floors;
  for (const Building& building : buildings) {
    for (const Facet& facet : building.facets) {
      if (!building.watertight || facet.facet_class != FacetClass::kGround) continue;
      Polygon& floor = floors.emplace_back(InGroundPlan(facet, upright_from_world));
      for (Ring& ring : floor.rings) std::ranges::reverse(ring);  // floors look down
    }
  }
  return floors;
}

}  // namespace stucco
