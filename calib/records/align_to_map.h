// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "calib/records/read_records.h"
#include "calib/records/shift_onto_map.h"
#include "calib/scene/scene.h"
#include "survey/georef.h"
#include "survey/plan.h"
#include "survey/pose.h"

namespace stucco {

// Where a model lies against the walls of the map that its flight was planned on. Receivers without
// corrections are off by metres together, maps by decimetres.
struct MapAlignment {
  Similarity map_from_scene;                          // level: turns about z, scale 1
  Eigen::Vector2d shift_m = Eigen::Vector2d::Zero();  // that it moves the middle of the walls by
  double turn_rad = 0;                                // counter-clockwise
  double sigma_m = 0;                                 // one standard deviation of the shift
  int walls = 0;                                      // on which it was measured
};

// The plan's map in a survey's world frame. Heights become the survey's by the median of what the
// photos' expected poses (cam_from_plan, by photo) are above their poses. Requires a frame "enu".
SiteMap MapInScene(const Plan& plan, const Georef& georef,
                   const std::vector<std::optional<Pose>>& expected, const Scene& scene);

// Shift and turn (prior: 0.3 degrees) that bring points onto walls, from ShiftOntoMap on: the
// middle one of the points about each wall, least squares over walls with Tukey's biweight, since a
// wall of the map may be off by itself. Nothing where fewer than four walls, walls of one direction
// only, or fewer than half of those with points about them show as planes: another map, or trees.
std::optional<MapAlignment> AlignToWalls(std::span<const Eigen::Vector3d> points,
                                         const SiteMap& map);

// Moves poses, points and the records' places and directions.
void MoveToMap(const MapAlignment& alignment, std::vector<PoseRecord>& records, Scene& scene);

}  // namespace stucco
