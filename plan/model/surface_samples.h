// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "plan/site.h"

namespace stucco::plan {

enum class SurfaceKind : uint8_t { kWall, kRoof, kGround };

// A point of the 2.5D model that photos should show.
struct SurfaceSample {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  // outward
  SurfaceKind kind = SurfaceKind::kWall;
  int facade = -1;  // of walls: index into Site::facades
};

struct SampleOptions {
  double spacing_m = 3.5;
  double ground_reach_m = 20;  // ground counts as far as this from the buildings of the area
};

// Samples of every facade (rows of at least two), of every roof of the area (at least one each, not
// where another part stands on it) and of the ground around those buildings, inside Site::area.
// In the order facades, roofs, ground.
std::vector<SurfaceSample> SampleSurface(const Site& site, const SampleOptions& options);

}  // namespace stucco::plan
