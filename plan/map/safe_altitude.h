// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <vector>

#include "plan/map/read_obstacles.h"
#include "plan/options/plan_options.h"
#include "site/site.h"

namespace stucco::plan {

// What the safe altitude is above: footprints as a map has them, z above the ground.
struct HighThings {
  const std::filesystem::path& map;
  const std::vector<Footprint>& footprints;
  const std::vector<MapObstacle>& obstacles;
};

// H of the options, else d_min above the tallest building and obstacle. Heights guessed from
// storeys are no heights here. Throws Error: kBadInput where some have no height and the options no
// H (with an H that the storeys suggest), or where metres cannot be meant; kUsage where H is too
// low.
double SafeAltitude(const HighThings& things, const PlanOptions& options, const RepairLog& repairs);

// What a person has to check about it, a line each.
std::vector<std::string> AltitudeWarnings(const HighThings& things, double safe_altitude_m,
                                          double d_min_m);

}  // namespace stucco::plan
