// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulate/city/facets.h"

#include <Eigen/Geometry>
#include <utility>

namespace stucco::simulate {

Eigen::Vector3d AreaVector(const Loop& loop) {
  Eigen::Vector3d area = Eigen::Vector3d::Zero();
  for (size_t i = 1; i + 1 < loop.size(); ++i) {
    area += (loop[i] - loop[0]).cross(loop[i + 1] - loop[0]) / 2;
  }
  return area;
}

Facet ExactFacet(FacetClass facet_class, Loop outer, std::vector<Loop> holes) {
  Facet facet;
  facet.facet_class = facet_class;
  Eigen::Vector3d area = AreaVector(outer);
  facet.normal = area.normalized();
  for (const Loop& hole : holes) area += AreaVector(hole);
  facet.offset = facet.normal.dot(outer[0]);
  facet.area = area.norm();
  facet.outer = std::move(outer);
  facet.holes = std::move(holes);
  facet.seen = 1;
  facet.source = "model";
  return facet;
}

}  // namespace stucco::simulate
