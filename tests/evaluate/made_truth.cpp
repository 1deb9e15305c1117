// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/evaluate/made_truth.h"

#include <Eigen/Geometry>

namespace stucco::evaluate {

using Eigen::Vector3d;

Facet MadeFacet(const std::string& id, FacetClass facet_class, const std::vector<Vector3d>& outer) {
  Facet facet;
  facet.id = facet.facade = id;
  facet.facet_class = facet_class;
  facet.outer = outer;
  Vector3d twice_area = Vector3d::Zero();
  for (size_t i = 1; i + 1 < outer.size(); ++i) {
    twice_area += (outer[i] - outer[0]).cross(outer[i + 1] - outer[0]);
  }
  facet.normal = twice_area.normalized();
  facet.offset = facet.normal.dot(outer[0]);
  facet.area = twice_area.norm() / 2;
  facet.seen = 1;
  facet.source = "planes";
  return facet;
}

Building MadeBox(const std::string& id, const Vector3d& low, const Vector3d& high) {
  const auto corner = [&](bool east, bool north, bool up) {
    return Vector3d(east ? high.x() : low.x(), north ? high.y() : low.y(), up ? high.z() : low.z());
  };
  const std::vector<Vector3d> foot = {corner(false, false, false), corner(true, false, false),
                                      corner(true, true, false), corner(false, true, false)};
  const Vector3d rise(0, 0, high.z() - low.z());
  Building building{.id = id, .watertight = true, .source = "cloud", .facets = {}};
  std::vector<Vector3d> top;
  for (size_t i = 0; i < 4; ++i) {
    const Vector3d &a = foot[i], &b = foot[(i + 1) % 4];
    building.facets.push_back(
        MadeFacet(id + "/F0" + std::to_string(i), FacetClass::kWall, {a, b, b + rise, a + rise}));
    top.push_back(a + rise);
  }
  building.facets.push_back(MadeFacet(id + "/R0", FacetClass::kRoof, top));
  building.facets.push_back(
      MadeFacet(id + "/G0", FacetClass::kGround, {foot[0], foot[3], foot[2], foot[1]}));
  return building;
}

Proxy MadeTruth() {
  Proxy truth;
  truth.metric = true;
  truth.buildings = {MadeBox("B0001", {0, 0, 0}, {10, 8, 6}),
                     MadeBox("B0002", {22, 0, 0}, {30, 8, 9})};
  Facet ground = MadeFacet("G0", FacetClass::kGround,
                           {{-15, -15, 0}, {45, -15, 0}, {45, 23, 0}, {-15, 23, 0}});
  for (const Building& building : truth.buildings) {
    ground.holes.push_back(building.facets.back().outer);  // seen from below: clockwise from above
    ground.area -= building.facets.back().area;
  }
  truth.buildings.push_back(
      {.id = "G0", .watertight = false, .source = "cloud", .facets = {ground}});
  return truth;
}

}  // namespace stucco::evaluate
