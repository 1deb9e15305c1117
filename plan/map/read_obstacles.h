// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "plan/map/repairs.h"
#include "plan/options/plan_options.h"
#include "site/site.h"

namespace stucco::plan {

// Buildings and obstacles farther than this from where drones may be do not matter.
inline constexpr double kSurroundings_m = 300;

// A tree, a crane, a wire: what is in the way and is no building.
struct MapObstacle {
  std::string id;  // O0003
  Polygon outline;
  std::optional<double> height_m;  // of the top above the ground
};

// The obstacles of a file (see ReadObstacleMap) in the frame of the plan. Throws Error.
std::vector<MapObstacle> ReadObstacles(const std::filesystem::path& path,
                                       const PlanOptions& options, const PlanOrigin& origin,
                                       RepairLog& repairs);

// Puts obstacles among the footprints of a site that has its buildings and its terrain, with `z_m`
// above the ground as PlaceOnGround takes it. Footprints must not cross: an obstacle gives way to
// buildings and to higher obstacles, and stays 6 cm away from them; buildings that it reaches over
// are marked with how far (`overgrown_to_m`), so that together they forbid what it forbids (but for
// those centimetres). Obstacles far from all buildings are left out.
void AddObstacles(std::vector<MapObstacle> obstacles, Site& site);

}  // namespace stucco::plan
