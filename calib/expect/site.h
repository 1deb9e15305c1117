// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <vector>

#include "survey/plan.h"

namespace stucco {

// A point on what the plan knows of the site, as a stand-in for what photos will show.
struct SitePoint {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  // frame of the plan
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();   // outwards
  int wall = -1;                                       // index into Plan::facades; -1: roof, ground
};

// Points on walls, roofs (flat, at the top of their footprint) and the ground around the buildings,
// on grids with this spacing, as far as they lie in `area`. The ground is level at the foot of the
// nearest building. Points of one wall follow each other, walls in the order of Plan::facades.
std::vector<SitePoint> SampleSite(const Plan& plan, double spacing_m,
                                  const Eigen::AlignedBox2d& area);

// Buildings as prisms without floor, and the ground far around them.
struct SiteMesh {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<std::array<uint32_t, 3>> triangles;
};
SiteMesh MeshOfSite(const Plan& plan);

}  // namespace stucco
