// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "site/frustum.h"
#include "survey/plan.h"

namespace stucco::plan {

// The part of a facade that a photo is meant for.
struct Target {
  int facade = 0;  // index into Site::facades
  Interval along_m;
  Interval z_m;
};

// One photo of a hover. The horizon is level in it.
struct Shot {
  double yaw_rad = 0;    // clockwise from north
  double pitch_rad = 0;  // 0 level, -pi/2 down
  ViewKind kind = ViewKind::kDipping;
  std::vector<Target> targets;

  // Unit viewing direction (east, north, up).
  Eigen::Vector3d Direction() const;
};

// A point where the drone stops, with the photos it takes there in this order. What every planning
// method makes, and what path, evaluation and mission files work on.
struct Hover {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  std::vector<Shot> shots;
};

// The hover as a place with pictures, in the order of its shots.
Viewpoint ViewpointOf(const FieldOfView& field, const Hover& hover, double reach_m);

}  // namespace stucco::plan
