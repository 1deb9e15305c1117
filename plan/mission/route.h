// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "survey/plan.h"
#include "survey/plan_frame.h"

namespace stucco::plan {

// A point of a flight as mission files need it.
struct MissionStop {
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();  // in the frame of the plan
  Geodetic geodetic;
  double height_m = 0;  // above the take-off point
  double yaw_deg = 0;   // heading on arrival: of the first photo here, else of the next one
  std::vector<PlannedView> views;  // in order of capture; empty: passes
};

// One flight from take-off to landing, without the points on the ground. Between them the drone
// flies straight lines.
struct MissionRoute {
  std::vector<MissionStop> stops;
  Eigen::Vector3d home_m = Eigen::Vector3d::Zero();  // where it takes off, in the frame of the plan
  double take_off_height_m = 0;                      // above home: climb to it before anything else
  double return_height_m = 0;                        // above home: nothing of the site reaches it
  double length_m = 0;
  double time_min = 0;
};

// A route per flight. Throws Error (kStageFailed) when the plan has no flights.
std::vector<MissionRoute> MissionRoutes(const Plan& plan);

// A route for autopilots that go to the first point the straight way: it starts and ends at return
// height, straight above its first and last point.
std::vector<MissionStop> WithApproach(const Plan& plan, const MissionRoute& route,
                                      std::vector<MissionStop> stops);

// Smaller turns of drone and camera are not commanded: the drone does not hold them either.
inline constexpr double kSmallTurn_deg = 0.05;

// In (-180, 180] and [0, 360).
double SignedDegrees(double degrees);
double CompassDegrees(double degrees);

// "mission.kmz" of the first of one, "mission_2.kmz" of the second of several.
std::string NumberedName(const std::string& stem, const std::string& extension, size_t index,
                         size_t count);

}  // namespace stucco::plan
