// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/verbs/plan.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "pipeline/engine/events.h"
#include "pipeline/engine/lock.h"
#include "pipeline/engine/outputs.h"
#include "pipeline/engine/progress.h"
#include "pipeline/engine/resources.h"
#include "pipeline/engine/settings.h"
#include "pipeline/engine/work_folder.h"
#include "pipeline/verbs/init.h"
#include "plan/map/read_site.h"
#include "plan/plan_site.h"
#include "survey/error.h"
#include "survey/files.h"
#include "survey/survey_folder.h"

namespace stucco {
namespace {

namespace fs = std::filesystem;

plan::PlanOptions ReadOptions(const std::vector<std::string>& set) {
  plan::PlanOptions options;
  OptionTable table(kPlanFolder);
  plan::Describe(table, options);
  std::vector<std::string> problems;
  for (const std::string& item : set) {
    const size_t equals = item.find('=');
    const std::string problem = SetOptionFromText(
        table, item.substr(0, equals), equals == std::string::npos ? "" : item.substr(equals + 1));
    if (!problem.empty()) problems.push_back(problem);
  }
  if (!problems.empty()) {
    throw Error(ErrorKind::kUsage, fmt::format("{}", fmt::join(problems, "\n")),
                "stucco plan --help lists the options");
  }
  return options;
}

plan::SiteInputs InputsOf(const PlanRequest& request) {
  plan::SiteInputs inputs;
  inputs.map = request.map;
  if (!request.area.empty()) inputs.area_of_interest = request.area;
  if (!request.no_fly.empty()) inputs.no_fly = request.no_fly;
  if (!request.obstacles.empty()) inputs.obstacles = request.obstacles;
  if (!request.terrain.empty()) inputs.dem = request.terrain;
  if (!request.home.empty()) inputs.home = request.home;
  return inputs;
}

}  // namespace

void ForPlanOptions(const std::function<void(const Option&)>& fn) {
  plan::PlanOptions defaults;
  OptionTable table(kPlanFolder);
  plan::Describe(table, defaults);
  for (const Option& option : table.options()) fn(option);
}

plan::PlanSummary PlanSurvey(const fs::path& survey, const PlanRequest& request,
                             const StageTable& table, Console& console, const Platform& platform) {
  if (survey.empty()) {
    throw Error(ErrorKind::kUsage, "--out: names no folder", "give the folder of the survey");
  }
  const plan::PlanOptions options = ReadOptions(request.set);
  const int threads = request.threads > 0 ? request.threads : AvailableCores();
  // All that can be wrong with the input shows before the survey is touched.
  const Site site = plan::ReadSite(InputsOf(request), options);
  InitWaitingSurvey(survey, table);
  const SurveyLock lock(survey, fmt::format("plan {}", request.map.string()), platform);
  CleanScratch(survey);
  ScratchFolder scratch(survey, kPlanFolder);
  EventLog events(WorkFolder(survey).Events());
  plan::PlanSummary summary;
  {
    StageProgress progress(kPlanFolder, console, events, platform.interrupted);
    summary = plan::PlanSite(site, options, threads, progress, scratch.path());
  }
  if (const auto moved = scratch.Publish(platform)) {
    summary.notes.push_back(fmt::format("a folder {} that stucco did not make is now {}",
                                        kPlanFolder, moved->string()));
  }
  return summary;
}

}  // namespace stucco
