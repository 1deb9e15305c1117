// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "evaluate/geometry/moved.h"

namespace stucco::evaluate {

Facet Moved(const Facet& facet, const Similarity& new_from_old) {
  Facet moved = facet;
  moved.normal = new_from_old.rotation * facet.normal;
  moved.offset = new_from_old.scale * facet.offset + moved.normal.dot(new_from_old.translation);
  moved.area *= new_from_old.scale * new_from_old.scale;
  moved.rms *= new_from_old.scale;
  for (Eigen::Vector3d& point : moved.outer) point = new_from_old * point;
  for (auto& hole : moved.holes) {
    for (Eigen::Vector3d& point : hole) point = new_from_old * point;
  }
  return moved;
}

Proxy Moved(const Proxy& proxy, const Similarity& new_from_old) {
  Proxy moved = proxy;
  moved.up = new_from_old.rotation * proxy.up;
  for (Building& building : moved.buildings) {
    for (Facet& facet : building.facets) facet = Moved(facet, new_from_old);
  }
  return moved;
}

}  // namespace stucco::evaluate
