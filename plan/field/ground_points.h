// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "plan/match/photo_coverage.h"
#include "survey/plan.h"

namespace stucco::plan {

// Where to lay and measure a target.
struct GroundPoint {
  std::string name;   // G1 of control, C1 of check points
  std::string where;  // "south-west corner"
  CoveredPlace place;
};

// Control in the four corners and the middle, check points in the middles of the two short sides:
// such a frame around the site holds its scale and its tilt, and its middle keeps a survey from
// bulging (James and Robson, "Mitigating systematic error in topographic models derived from UAV
// and ground-based image networks", 2014). In each of these parts of the box around the walls, 15 m
// wider, it is the ground that most planned photos show, at least four of them and at least 3 m
// from walls and obstacles; parts without such ground have none.
std::vector<GroundPoint> ProposeGroundPoints(const Plan& plan, const PhotoCoverage& coverage);

}  // namespace stucco::plan
