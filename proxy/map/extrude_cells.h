// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "proxy/facets/arrangement.h"
#include "survey/geometry2d.h"

namespace stucco {

// A plane over the ground plan: z = slope . (x, y) + height.
struct RoofPlane {
  Eigen::Vector2d slope = Eigen::Vector2d::Zero();
  double height = 0;

  double At(const Eigen::Vector2d& p) const { return slope.dot(p) + height; }
};

// A face of the solid over the cells, in the upright frame (z up).
struct ExtrudedFace {
  enum class Kind { kWall, kRoof, kFloor, kUnderside };
  Kind kind = Kind::kWall;
  int roof = -1;   // label of a roof
  Segment2d foot;  // of a wall, seen from above, the solid on its left
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  // unit, outwards
  double offset = 0;
  std::vector<Eigen::Vector3d> outer;
  std::vector<std::vector<Eigen::Vector3d>> holes;
};

// What stands on each cell of a ground plan.
struct Storeys {
  std::vector<int> labels;  // numbers of roofs, -1 where nothing stands
  std::span<const RoofPlane> roofs;
  double ground = 0;
  // Level undersides where it does not stand on the ground; empty: everywhere it does.
  std::vector<double> floors = {};
};

// The solid between the floor and the roof of each cell. Upright walls close it where the building
// ends and where roofs or floors of neighbouring cells differ in height. Closed, 2-manifold and
// oriented outwards by construction, but for corners where cells touch in one point
// (JoinAtCorners). Faces next to each other have the very same corners. `lines` are those the
// arrangement was made of. Requires roofs above the floors of their cells; a roof that crosses the
// floor of the cell beside it leaves the solid open.
std::vector<ExtrudedFace> ExtrudeCells(Arrangement arrangement, std::span<const CutLine> lines,
                                       Storeys storeys);

// Gives cells another neighbour's label until no two parts of the solid touch in an upright edge
// only, as high and low cells do that alternate around a corner. Where one roof lies on both sides
// of a corner, the smallest open cell there `inside` the footprint is roofed over.
void JoinAtCorners(const Arrangement& arrangement, std::span<const RoofPlane> roofs,
                   const std::vector<bool>& inside, std::vector<int>& labels);

}  // namespace stucco
