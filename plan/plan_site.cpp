// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/plan_site.h"

#include "plan/make_plan.h"

namespace stucco::plan {

PlanSummary PlanSite(const Site& site, const PlanOptions& options, int threads, Progress& progress,
                     const std::filesystem::path& folder) {
  for (const std::string& repair : site.repairs) progress.Note(repair);
  const PlanResult result = MakePlan(site, options, threads, progress);
  PlanSummary summary;
  summary.method = result.plan.method;
  summary.photos = result.plan.views.size();
  summary.hovers = static_cast<size_t>(result.stats.hovers);
  summary.flights = result.plan.flights.size();
  summary.length_m = result.stats.length_m;
  summary.time_min = result.stats.time_min;
  summary.battery_percent = result.stats.battery_percent;
  summary.table = StatsTable(result.stats);
  summary.repairs = site.repairs;
  summary.warnings = result.stats.warnings;
  summary.notes = WritePlanFolder(result, options, folder);
  return summary;
}

}  // namespace stucco::plan
