// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "survey/intervals.h"

namespace stucco {

// What a photo is for.
enum class ViewKind {
  kDipping,      // level, at one facade, from between the buildings
  kDippingFoot,  // tilted down at the foot of the wall, at the bottom of a dipping sequence
  kNadir,        // straight down
  kOblique,      // tilted, from above the buildings
  kSurface,      // aimed at one point of the model (method dronescan)
};
std::string_view Name(ViewKind kind);  // "dipping", "dipping_foot", "nadir", "oblique", "surface"
std::optional<ViewKind> ViewKindFromName(std::string_view name);

// The part of a facade that a view is meant to paint: along it from `a`, and in height (z).
struct PlannedTarget {
  std::string facade;
  Interval along_m;
  Interval z_m;
};

// One photo to take. Positions are in the frame of the plan.
struct PlannedView {
  std::string id;  // letters and digits only: it becomes part of the photo's file name
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();
  double yaw_deg = 0;    // clockwise from north
  double pitch_deg = 0;  // 0 level, -90 down
  ViewKind kind = ViewKind::kDipping;
  int hover = 0;   // views taken from one point without moving on share it
  int order = 0;   // in the whole survey, from 0
  int flight = 0;  // from 0
  std::vector<PlannedTarget> targets;
};

// Predicted quality of a facade's texture, each term in [0, 1]: frontal and alike (s), close and
// equally far (d), few photos (u), complete (c). Paper: Xiong et al., "Aerial Path Planning for
// Urban Geometry and Texture Co-Capture" (2025), eq. 1.
struct FacadeQuality {
  double q_s = 0;
  double q_d = 0;
  double q_u = 0;
  double q_c = 0;
  double sum() const { return q_s + q_d + q_u + q_c; }
};

// A wall of the map from a to b, the building on its left; never without length.
struct PlannedFacade {
  std::string id;  // B0012/F03
  Eigen::Vector2d a_m = Eigen::Vector2d::Zero();
  Eigen::Vector2d b_m = Eigen::Vector2d::Zero();
  Interval z_m;  // foot and top; where not known the top is a bound, or what storeys suggest
  bool top_known = false;
  std::vector<std::string> views;  // meant for it, in order of capture
  FacadeQuality predicted;
  std::vector<Interval> unobservable_m;  // along the wall: no view from between the
                                         // buildings captures it (cocapture only)

  double length_m() const { return (b_m - a_m).norm(); }
  Eigen::Vector2d along() const { return (b_m - a_m).normalized(); }
  Eigen::Vector2d outwards() const { return {along().y(), -along().x()}; }
};

struct PlannedFootprint {
  std::string building;                               // B0012
  std::vector<std::vector<Eigen::Vector2d>> rings_m;  // outer counter-clockwise, then courtyards
  Interval z_m;
  double blocked_to_m = 0;   // nothing flies within d_min of it below this z
  bool is_obstacle = false;  // a tree, a crane, a wire: no building
};

// A stop of the flight or a point that it only passes.
struct PlannedWaypoint {
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();
  int hover = -1;  // -1: passes without a photo
};

// From home to home on one battery; straight lines between the points.
struct PlannedFlight {
  std::vector<PlannedWaypoint> waypoints;
  double length_m = 0;
  double time_min = 0;
  double battery_percent = 0;
};

// The camera that the plan was made for.
struct PlannedCamera {
  std::string name;   // "mavic-3e"
  std::string label;  // "DJI Mavic 3 Enterprise, wide"
  double focal_m = 0;
  double sensor_width_m = 0;
  double sensor_height_m = 0;
  int width_px = 0;
  int height_px = 0;
};

// Where the plan's frame lies: metres east and north of the origin on a transverse Mercator map
// whose central point is the origin, so that lengths and north are true there (within 1 cm and
// 0.001 degrees over two kilometres); z in metres above the origin's height.
struct PlanOrigin {
  double latitude_deg = 0;  // WGS 84
  double longitude_deg = 0;
  double height_m = 0;  // of z = 0, in the height system of the terrain; 0 without a terrain
};

struct Plan {
  std::string method;  // cocapture, oblique, dronescan
  std::string crs;     // PROJ text of the frame
  PlanOrigin origin;
  PlannedCamera camera;
  double d_min_m = 0;          // nothing flies nearer to a footprint below the safe altitude
  double d_max_m = 0;          // farthest wall that a view counts for
  double safe_altitude_m = 0;  // above the ground; nothing of the site reaches it
  double min_altitude_m = 0;   // above the ground; nothing flies lower
  Eigen::Vector3d home_m = Eigen::Vector3d::Zero();
  std::vector<PlannedFootprint> footprints;
  std::vector<std::vector<Eigen::Vector2d>> no_fly_m;
  std::vector<PlannedFacade> facades;
  std::vector<PlannedView> views;  // in order of capture
  std::vector<PlannedFlight> flights;
};

}  // namespace stucco
