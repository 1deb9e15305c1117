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
  kLink,         // half way between photos that would not match by themselves
};
// "dipping", "dipping_foot", "nadir", "oblique", "surface", "link"
std::string_view Name(ViewKind kind);
std::optional<ViewKind> ViewKindFromName(std::string_view name);

// The part of a facade that a view is meant to paint: along it from `a`, and in height (z).
struct PlannedTarget {
  std::string facade;
  Interval along_m;
  Interval z_m;
};

// Another photo that one should match.
struct PlannedPartner {
  std::string view;
  double strength = 0;  // what their frames show alike, in [0, 1]: plan/match/match_graph.h
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
  std::vector<PlannedPartner> partners;  // expected, the strongest first; none in older plans
  bool is_loose = false;  // too few should match it, or of a facade too few near to it
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

// What the time of a flight goes into, minutes.
struct PlannedTime {
  double transfer_min = 0;  // take-off, the ways from and to home, landing
  double legs_min = 0;      // from stop to stop
  double stops_min = 0;     // coming to rest and speeding up, turns and tilts on the spot
  double photos_min = 0;    // at rest before each photo, and the photo
};

// From home to home on one battery; straight lines between the points.
struct PlannedFlight {
  std::vector<PlannedWaypoint> waypoints;
  double length_m = 0;
  double time_min = 0;
  double battery_percent = 0;
  double reserve_percent = 0;  // kept for the way home from its farthest stop, against the wind
  PlannedTime parts;
  std::optional<Eigen::Vector3d> home_m;  // its take-off point; none: that of the plan
};

// How the flights are flown: what mission files command and what time and energy are reckoned by.
// This is the one place for these figures.
struct PlannedPace {
  double speed_m_per_s = 5;           // between photos; slow enough to stop within d_min
  double transfer_speed_m_per_s = 8;  // to the first point, and home
  double hold_s = 1.5;                // commanded before each photo, for the gimbal to settle
  // What drones do of themselves. Assumed: half of what the data sheet of the Mavic 3E rates for
  // turns (200 degrees/s) and tilts (100), two thirds for climbing (6 m/s), half for sinking.
  double climb_m_per_s = 4;
  double sink_m_per_s = 3;
  double yaw_deg_per_s = 100;
  double tilt_deg_per_s = 50;
  double shutter_s = 0.7;  // least interval of photos, data sheet of the Mavic 3E
  double ground_s = 20;    // motors on to leaving the ground, and the last metre down
  double corner_s = 2.5;   // slowing down and speeding up at a point that is passed, at 2 m/s2
  double stop_s = 5.32;    // the same, and coming to rest, where photos are: bench/fit_energy.py
  double wind_m_per_s = 3;
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
  Eigen::Vector3d home_m = Eigen::Vector3d::Zero();  // of flights that have none of their own
  std::vector<PlannedFootprint> footprints;
  std::vector<std::vector<Eigen::Vector2d>> no_fly_m;
  std::vector<PlannedFacade> facades;
  std::vector<PlannedView> views;  // in order of capture
  std::vector<PlannedFlight> flights;
  PlannedPace pace;

  Eigen::Vector3d HomeOf(const PlannedFlight& flight) const {
    return flight.home_m.value_or(home_m);
  }
  // Of a flight by number; that of the plan where the plan has no such flight.
  Eigen::Vector3d HomeOf(int flight) const;
  // Each take-off point once, in the order of the flights; without flights that of the plan.
  std::vector<Eigen::Vector3d> Homes() const;
};

}  // namespace stucco
