// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "simulate/city/facets.h"
#include "simulate/city/pitched_roof.h"
#include "survey/geometry2d.h"
#include "survey/proxy.h"

namespace stucco::simulate {

// A building without relief: planar faces that share vertices.
struct Solid {
  struct Face {
    FacetClass facet_class = FacetClass::kWall;
    int edge = -1;                        // of the outline, counted over its rings; roofs in one
                                          // piece and floors: -1
    std::vector<int> outer;               // counter-clockwise from outside
    std::vector<std::vector<int>> holes;  // clockwise
  };
  std::vector<Eigen::Vector3d> vertices;
  std::vector<Face> faces;  // walls by edge, then roofs, then the floor
};

Loop Corners(const Solid& solid, const std::vector<int>& ring);

// Walls from `base_m` to `eaves_m` with a flat roof, or with a pitched one on top.
Solid MakeSolid(const Polygon& outline, double base_m, double eaves_m,
                const std::optional<PitchedRoof>& roof);

// What keeps the solid from being closed: an edge that does not border exactly two faces, in
// opposite directions.
std::optional<std::string> FindGap(const Solid& solid);

}  // namespace stucco::simulate
