// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <vector>

#include "proxy/cloud/samples.h"
#include "proxy/map/outlines.h"
#include "proxy/map/upright_survey.h"

namespace stucco {

// Where the survey shows the map, or why it does not.
struct MapRegistration {
  Eigen::Isometry2d survey_from_map = Eigen::Isometry2d::Identity();  // of an OutlineMap
  double turn_rad = 0;                                                // counter-clockwise
  Eigen::Vector2d shift_m = Eigen::Vector2d::Zero();                  // of the middle of the map
  bool measured = false;      // else it was not moved: a scan from above lies where it says
  double raised_inside = 0;   // share of what the cloud shows of the footprints that is no ground
  double raised_outside = 0;  // the same next to them
  std::string refused;        // empty: the map is of this place
};

// Whether a normal is of a wall: within 15 degrees of level.
bool LooksLikeWall(const Eigen::Vector3d& normal);
// What lies this far above the ground is part of a building, or of what grows or parks beside it.
inline constexpr double kRaised_m = 2;

// The upright things of the cloud as short pieces of line seen from above, what they enclose on
// their left: samples that look level, by cells of the ground plan in which they are at least a
// metre high.
std::vector<Segment2d> WallTraces(const Samples& upright);

// Finds the rigid motion (15 m and about a degree) that brings the facades onto what stands upright
// in the cloud: the shift as facade_ids.h finds it, then least squares with Tukey's biweight over
// shift and turn (prior: 0.3 degrees, against half a metre that each facade may be off by itself).
// Refused when fewer than half of the facades within the cloud, or of what stands upright, find one
// another, or when the footprints are not what is raised above the ground: a map of another town
// finds some walls anywhere. A scan without photos and walls lies where it says: it is not moved.
MapRegistration RegisterMap(const UprightSurvey& survey, const OutlineMap& map);

}  // namespace stucco
