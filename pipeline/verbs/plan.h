// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "pipeline/engine/console.h"
#include "pipeline/engine/platform.h"
#include "pipeline/engine/stages.h"
#include "plan/plan_site.h"

namespace stucco {

// What is planned, as the user names it. Empty paths and texts: not given.
struct PlanRequest {
  std::filesystem::path map;
  std::filesystem::path area;    // polygons: what to capture
  std::filesystem::path no_fly;  // polygons
  std::filesystem::path obstacles;
  std::filesystem::path terrain;
  std::string home;              // "latitude,longitude"
  std::vector<std::string> set;  // options of planning, "gsd_m=0.02"
  int threads = 0;
};

// Plans a survey and puts the result into SURVEY/plan. A folder that is no survey yet becomes one
// that waits for its photos in SURVEY/photos. A failed or interrupted plan leaves what was there.
// Throws Error.
plan::PlanSummary PlanSurvey(const std::filesystem::path& survey, const PlanRequest& request,
                             const StageTable& table, Console& console, const Platform& platform);

// Calls fn for each option of planning, at its default: for help texts.
void ForPlanOptions(const std::function<void(const Option&)>& fn);

}  // namespace stucco
