// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>
#include <span>
#include <vector>

#include "proxy/map/wall_among.h"

namespace stucco {

// A wall of a map that points hold, and where they are: seen from above, metres.
struct HeldWall {
  Eigen::Vector2d middle, outwards;  // as the map has it
  double offset = 0;                 // of the points, outwards, at the middle
  double turn = 0;                   // of the points, counter-clockwise, radians
  double span = 0;                   // of what tells the turn
};

// Buildings that stand wall to wall: one drew them together.
struct HeldGroup {
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  std::vector<HeldWall> walls = {};
};

// By how much a group has to be moved: turned about its middle, then shifted.
struct GroupMotion {
  Eigen::Vector2d shift = Eigen::Vector2d::Zero();
  double turn = 0;
};

// What is known of the errors of a map before its walls are looked at.
struct MapPrior {
  std::vector<GroupMotion> done;     // by group: how they have been moved already
  double shift_sigma = kMapSigma_m;  // of all of it, per axis
  double turn = 0;                   // of most groups, all of it
  double turn_sigma = kMapTurn_rad;
};

// How the buildings of a map lie against the walls: each group moved, and all of them too large or
// too small, as where a map traces eaves. Found together: of a building that shows one wall only,
// nothing else tells the one from the other.
struct MapErrors {
  std::vector<GroupMotion> motions;  // by group
  double outset = 0;                 // of the walls from the outlines
};

// Least squares over all walls; one that stands far out of line has less to say (Huber).
MapErrors ErrorsOf(std::span<const HeldGroup> groups, const MapPrior& prior);

// How far walls lie from where the errors of the map put them, by what most of them do, metres.
double SpreadOf(std::span<const HeldGroup> groups, const MapErrors& errors);

// The prior once groups have been moved by `errors`, too: of a map that puts other buildings where
// they stand, one wall that is seen badly does not move one.
MapPrior Learned(std::span<const HeldGroup> groups, const MapErrors& errors, MapPrior prior);

// The motion as one of the ground plan.
Eigen::Isometry2d IsometryOf(const GroupMotion& motion, const Eigen::Vector2d& middle);

}  // namespace stucco
