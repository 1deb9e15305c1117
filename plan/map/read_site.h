// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "plan/options/plan_options.h"
#include "site/site.h"

namespace stucco::plan {

// The files and places that a plan is made from.
struct SiteInputs {
  std::filesystem::path map;
  std::optional<std::filesystem::path> area_of_interest = {};  // a map of areas; see ReadAreas
  std::optional<std::filesystem::path> no_fly = {};            // likewise
  std::optional<std::filesystem::path> obstacles = {};         // see ReadObstacles
  std::optional<std::filesystem::path> dem = {};               // see ReadDem
  std::optional<std::string> home = {};                        // "latitude,longitude"
};

// All that the planner knows about the place, from the map and what goes with it. Buildings that
// the area of interest does not touch are obstacles only; those far from it are left out. Without
// an area of interest all buildings are captured. Heights are above the lowest ground under a
// building. The safe altitude is that of the options, else d_min above the tallest building or
// obstacle, all of which then need a height (see SafeAltitude). Throws Error (kBadInput, kUsage)
// with what to do about it; what could be mended is in `repairs`, what is left open in `warnings`.
Site ReadSite(const SiteInputs& inputs, const PlanOptions& options);

}  // namespace stucco::plan
