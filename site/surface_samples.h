// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <vector>

#include "site/site.h"

namespace stucco {

enum class SurfaceKind : uint8_t { kWall, kRoof, kGround };

// A point of the 2.5D model that photos should show.
struct SurfaceSample {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  // outward
  SurfaceKind kind = SurfaceKind::kWall;
  int facade = -1;     // of walls: index into Site::facades
  int footprint = -1;  // of roofs: index into Site::footprints
};

struct SampleOptions {
  double spacing_m = 3.5;
  std::vector<double> roof_spacings_m = {};  // by footprint, with kTerrain; empty: `spacing_m`
  bool never_farther = false;  // than `spacing_m` from each other on a wall; else about as far
  int fewest_rows = 2;         // of a wall
  double ground_reach_m = 20;  // ground counts as far as this from the buildings
  std::vector<Segment2d> ground_along =
      {};                    // with GroundRule::kTerrain ground counts near these too
  bool area_only = true;     // with GroundRule::kTerrain; false: obstacles and what is around too
  double off_surface_m = 0;  // lifts samples off, so that their own surface cannot hide them
  std::optional<Eigen::AlignedBox2d> within = {};  // nothing: everywhere
};

// Samples of facades, then of roofs and ground. Those of one facade follow each other, facades in
// the order of the site.
//
// With GroundRule::kTerrain roofs of the area have at least one sample each, none where another
// part stands on them, and the ground is that around these buildings, inside Site::area; roofs come
// before it. With kNearestFoot roofs (of the footprint that covers a cell last) and ground (in the
// box around all footprints) are one grid.
std::vector<SurfaceSample> SampleSurface(const Site& site, const SampleOptions& options);

}  // namespace stucco
