// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "survey/geometry2d.h"

namespace stucco::simulate {

enum class RoofShape { kFlat, kGabled, kHipped };

// A pitched roof over an outline. Heights are above the eaves.
struct PitchedRoof {
  struct Face {
    int edge = 0;              // of the outline, counted over its rings, whose eaves it rises from
    std::vector<int> corners;  // counter-clockwise from above
  };
  std::vector<Eigen::Vector3d> vertices;  // the outline's corners in order, then those of ridges
  std::vector<Face> faces;
  std::vector<int> apex_of;  // by edge of the outline: the top of its gable, -1 where eaves are
};

// All eaves are at one height and all slopes rise by `slope` metres in a metre: the straight
// skeleton of the outline (Aichholzer et al., "A novel type of skeleton for polygons", 1995).
// Where a wing ends in a hip between parallel walls, kGabled moves the tip of the hip out into the
// wall, which keeps the planes of the slopes. `gables` names edges that become gables in any case
// where they end such a wing; for a rectangle two opposite ones say how its ridge runs, otherwise
// it runs along the longer side.
PitchedRoof MakePitchedRoof(const Polygon& outline, RoofShape shape, double slope,
                            const std::vector<bool>& gables = {});

}  // namespace stucco::simulate
