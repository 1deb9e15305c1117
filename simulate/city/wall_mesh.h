// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "simulate/city/city_model.h"
#include "simulate/paint/wall_design.h"

namespace stucco::simulate {

// A wall to be built: its picture lies on its plane.
struct WallShape {
  Sheet sheet;
  int pane_material = 0;  // the same picture, with gloss
  Trim trim;
  std::vector<Eigen::Vector2d> outline;  // on the picture, in metres, counter-clockwise as seen
  bool corner_left = false;   // whether the house turns away there by a right angle, so that
  bool corner_right = false;  // cornices run around
};

// Whether a part's front is glass, which mirrors.
bool HasPane(const WallPart& part);

// The wall with its parts in relief. What is set back or stands out takes its front from the
// picture at the place where it is seen at right angles; sides are trim. A balcony's front is
// closed, and the wall behind it is trim too, as the picture shows the balcony there.
void AddWall(const WallShape& shape, const WallDesign& design, CityModel& model);

}  // namespace stucco::simulate
