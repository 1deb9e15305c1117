// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "site/site.h"
#include "survey/geometry2d.h"
#include "survey/georef.h"
#include "survey/plan.h"

namespace stucco {

// A part of a building that begins above the ground.
struct RaisedPart {
  Polygon outline;
  double underside_m = 0;  // in the plan's heights
};

// A part of a building below which nothing stands, as above a passage.
struct HangingPart {
  size_t part = 0;         // of the building's parts
  double underside_m = 0;  // in the plan's heights
};

// A building of the plan, in the ground plan of the survey.
struct MapBuilding {
  std::string id;
  std::vector<Polygon> parts;             // without overlaps
  std::vector<HangingPart> hanging = {};  // of them
  std::vector<RaisedPart> raised = {};    // what stands on them, at least in part
  Interval z_m;                           // foot and top, in the plan's heights
  bool top_known = false;
  bool to_capture = false;  // the plan has facades of it
};

// What the plan says of the place, in metres of the survey's upright frame: x and y in the ground
// plan, z along `up`. Obstacles and parts of buildings that stand on other parts are left out.
struct OutlineMap {
  std::vector<MapBuilding> buildings;  // in the plan's order, each id once
  // In the plan's order; a and b in the ground plan of the survey, all else as the plan has it.
  std::vector<Facade> facades;
};

// The id of the building that a facade is of: that of B0012/F03 is B0012.
inline std::string BuildingOf(const Facade& facade) {
  return facade.id.substr(0, facade.id.rfind('/'));
}

// The same building somewhere else.
MapBuilding Moved(const MapBuilding& building, const Eigen::Isometry2d& motion);

// From corner i to the next.
inline Segment2d EdgeOf(const Ring& ring, size_t i) {
  return {ring[i], ring[(i + 1) % ring.size()]};
}

Eigen::AlignedBox2d BoundsOf(const MapBuilding& building, double margin);
double Area(const MapBuilding& building);
// 0 inside.
double DistanceTo(const MapBuilding& building, const Eigen::Vector2d& p);
// To the nearest edge, from either side.
double ToOutline(const MapBuilding& building, const Eigen::Vector2d& p);

// From a frame whose z is `up` into the world, and back: the smallest rotation.
Eigen::Matrix3d UprightFromWorld(const Eigen::Vector3d& up);

// Requires georef.frame "enu". Positions are as the plan has them: the survey may show them some
// metres elsewhere (registration.h).
OutlineMap OutlinesOf(const Plan& plan, const Georef& georef, const Eigen::Vector3d& up);

}  // namespace stucco
