// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "plan/camera/preset.h"
#include "plan/field/flight_facts.h"
#include "plan/field/sun_window.h"
#include "plan/match/photo_coverage.h"
#include "plan/options/plan_options.h"
#include "plan/output/stats.h"
#include "site/site.h"
#include "survey/plan.h"
#include "survey/stage.h"

namespace stucco::plan {

struct PlanResult {
  Plan plan;
  PlanStats stats;
  PhotoCoverage coverage;
  std::vector<FlightFacts> flights;  // by flight of the plan
  std::vector<SunDay> days;          // that checklist.html has the hours of sun for
};

// Plans the views for a site with the method of the options, a path through them and its flights.
// The same site and options give the same plan at any number of threads. Throws Error (kBadInput
// where nothing can be planned, kInterrupted).
PlanResult MakePlan(const Site& site, const PlanOptions& options, int threads, Progress& progress);

// Writes plan.json, stats.json, preview.svg, coverage.svg, matches.svg, checklist.html,
// plan.geojson and the mission files into a folder that exists. Returns what the user has to know
// to fly them, a line each.
std::vector<std::string> WritePlanFolder(const PlanResult& result, const PlanOptions& options,
                                         const std::filesystem::path& folder);

}  // namespace stucco::plan
