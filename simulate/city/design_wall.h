// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "simulate/city/town.h"
#include "simulate/paint/wall_design.h"

namespace stucco::simulate {

// A wall of a house, upright from the house's foot.
struct WallPlace {
  int edge = 0;
  double width_m = 0;
  double top_m = 0;         // z of the picture's top edge: parapet, eaves or the tip of the gable
  double gable_rise_m = 0;  // of the triangle at the top; 0: none
};

bool HasBalconies(const House& house);  // on any of its walls, if they are long enough

// Windows, doors, balconies and what else is on a wall. Parts keep away from the ends of the wall
// and from each other, and lie on the wall wholly; party walls are blind. Walls of one house share
// its manner: window sizes, balconies, shops.
WallDesign DesignWall(const House& house, const WallPlace& place);

}  // namespace stucco::simulate
