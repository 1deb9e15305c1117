// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "plan/options/plan_options.h"
#include "site/site.h"
#include "survey/stage.h"

namespace stucco::plan {

// What was planned, for those who will fly it.
struct PlanSummary {
  std::string method;
  size_t photos = 0;
  size_t hovers = 0;
  size_t flights = 0;
  double length_m = 0;
  double time_min = 0;
  double battery_percent = 0;
  std::string table;                  // all figures, for people
  std::vector<std::string> repairs;   // of the map
  std::vector<std::string> warnings;  // what makes the flight less safe
  std::vector<std::string> notes;     // what to know before flying
};

// Plans the views for a site (MakePlan) and writes all files of the plan (WritePlanFolder) into a
// folder that exists. Throws Error (kBadInput where nothing can be planned, kInterrupted).
PlanSummary PlanSite(const Site& site, const PlanOptions& options, int threads, Progress& progress,
                     const std::filesystem::path& folder);

}  // namespace stucco::plan
