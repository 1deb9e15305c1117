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
  enum class Kind { kWall, kRoof, kFloor };
  Kind kind = Kind::kWall;
  int roof = -1;   // label of a roof
  Segment2d foot;  // of a wall, seen from above, the solid on its left
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  // unit, outwards
  double offset = 0;
  std::vector<Eigen::Vector3d> outer;
  std::vector<std::vector<Eigen::Vector3d>> holes;
};

// The solid between the level `ground` and the roof of each cell of the ground plan: labels are
// numbers of roofs, -1 cells where nothing stands. Upright walls close it where the building ends
// and where roofs of neighbouring cells differ in height. Closed, 2-manifold and oriented outwards
// by construction, but for corners where cells touch in one point (JoinAtCorners). Faces next to
// each other have the very same corners. `lines` are those the arrangement was made of. Requires
// roofs above the ground over their cells.
std::vector<ExtrudedFace> ExtrudeCells(Arrangement arrangement, std::span<const CutLine> lines,
                                       const std::vector<int>& labels,
                                       std::span<const RoofPlane> roofs, double ground);

// Gives cells another neighbour's label until no two parts of the solid touch in an upright edge
// only, as high and low cells do that alternate around a corner.
void JoinAtCorners(const Arrangement& arrangement, std::span<const RoofPlane> roofs,
                   std::vector<int>& labels);

}  // namespace stucco
