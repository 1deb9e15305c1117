// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <limits>
#include <string>
#include <vector>

#include "site/terrain_grid.h"
#include "survey/geometry2d.h"
#include "survey/plan.h"

namespace stucco {

// A building, or a part of one with a height of its own, or an obstacle such as a tree.
struct Footprint {
  std::string building;  // B0012; O0003 of an obstacle
  Polygon outline;
  Interval z_m;  // underside (ground, or above it for a part that stands on another) and top
  // False: no flight relies on the top. It is where the walls are expected to end, by the storeys
  // that the map counts, else the highest that the safe altitude allows.
  bool top_known = false;
  // Nothing flies within d_min of the outline below this z: the ceiling, or d_min above the top for
  // the parts of a building whose heights are all known; more where an obstacle reaches over it.
  double blocked_to_m = 0;
  bool in_area = true;       // false: in the way only, its walls are not captured
  bool is_obstacle = false;  // no building: hides walls, has none, joins none
  // z that obstacles reach to over the outline, such as a mast on the roof; infinite: not known.
  double overgrown_to_m = -std::numeric_limits<double>::infinity();
};

// A wall to capture: an edge of a footprint that stands free over `z_m`.
struct Facade {
  std::string id;                               // B0012/F03
  int footprint = 0;                            // index into Site::footprints; -1: none known
  Eigen::Vector2d a = Eigen::Vector2d::Zero();  // a to b with the building on the left
  Eigen::Vector2d b = Eigen::Vector2d::Zero();
  Interval z_m;
  bool top_known = false;

  double length_m() const { return (b - a).norm(); }
  Eigen::Vector2d along() const { return (b - a).normalized(); }
  Eigen::Vector2d normal() const {  // outward
    const Eigen::Vector2d u = along();
    return {u.y(), -u.x()};
  }
};

// Where the ground lies.
enum class GroundRule {
  kTerrain,      // where Site::terrain says
  kNearestFoot,  // level at the foot of the nearest building: plan.json has no terrain
};

// The 2.5D model of a place, in the frame of the plan: all that is known before a photo is taken.
// Made from a map (plan/map) or from a plan (site_of_plan.h).
struct Site {
  std::string crs;  // PROJ text of the frame
  PlanOrigin origin;
  std::vector<Footprint> footprints;  // interiors are disjoint, except parts above others
  std::vector<Facade> facades;        // by footprint, then ring, then edge
  std::vector<Polygon> no_fly;        // disjoint
  std::vector<Polygon> closed_off;    // what these part from home: nothing flies there either
  Polygon area;                       // grids of views stay inside it
  Eigen::Vector3d home = Eigen::Vector3d::Zero();
  std::vector<Eigen::Vector3d> take_off;  // other places where a flight may start; may be empty
  TerrainGrid terrain;
  GroundRule ground = GroundRule::kTerrain;
  double d_min_m = 10;               // the dilation of footprints
  double safe_altitude_m = 0;        // H: above the ground, d_min above the highest top
  double min_altitude_m = 5;         // above the ground
  std::vector<std::string> repairs;  // what was wrong with the map and was mended, a line each
  // What the map leaves open that safety rests on, a line each.
  std::vector<std::string> warnings = {};
  TerrainGrid ceiling;  // of CeilingAt; no samples: the safe altitude everywhere

  // z from which on nothing of the site is within d_min: H above the highest ground nearby (30 m),
  // and not below the `blocked_to_m` of any footprint within d_min. A constant where the terrain is
  // flat.
  double CeilingAt(const Eigen::Vector2d& position) const;
  // z below which a view may not be.
  double FloorAt(const Eigen::Vector2d& position) const {
    return terrain.HeightAt(position) + min_altitude_m;
  }
};

}  // namespace stucco
