// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/engine/status.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>

#include "pipeline/engine/hash_cache.h"
#include "pipeline/engine/settings.h"
#include "pipeline/engine/shell.h"
#include "pipeline/engine/work_folder.h"

namespace stucco {
namespace {

std::string NextStep(const SurveyStatus& status, const std::filesystem::path& survey) {
  if (status.running) {
    return fmt::format("wait: {} is at work", Describe(*status.running));
  }
  const auto failed = std::find_if(
      status.stages.begin(), status.stages.end(),
      [](const StageReport& report) { return report.assessment.state == StageState::kFailed; });
  if (failed != status.stages.end()) {
    const std::string& remedy = failed->assessment.failure->remedy;
    return fmt::format("{}stucco run {}",
                       remedy.empty() ? "" : remedy + ", then: ", ShellWord(survey.string()));
  }
  const bool all_done = std::all_of(
      status.stages.begin(), status.stages.end(),
      [](const StageReport& report) { return report.assessment.state == StageState::kDone; });
  return all_done ? fmt::format("open {}", (survey / kReportFile).string())
                  : fmt::format("stucco run {}", ShellWord(survey.string()));
}

}  // namespace

SurveyStatus GetStatus(const std::filesystem::path& survey, const StageTable& table,
                       const Platform& platform) {
  assert(FindProblem(table).empty());
  const Settings settings = LoadSettings(survey, table, {});
  const int threads = ResolvedThreads(settings.run);
  const SurveyPaths paths{survey, settings.photos};
  HashCache hashes(WorkFolder(survey).Hashes());
  SurveyStatus status;
  std::map<std::string, StageState> states;
  std::vector<StageStatus> statuses;
  for (const Stage& stage : table) {
    const Fingerprint now = TakeFingerprint(stage, settings.stages.at(stage.name),
                                            {paths, statuses, threads, hashes, SilentProgress()});
    Assessment assessment = Assess(stage, paths, now, threads, hashes);
    ApplyNeeds(stage, states, assessment);
    states[stage.name] = assessment.state;
    statuses.push_back(ToStatus(stage.name, assessment));
    status.stages.push_back({stage.name, stage.title, std::move(assessment)});
  }
  status.running = CurrentOwner(survey, platform);
  if (!status.running) {
    hashes.Save();
  }
  status.next = NextStep(status, survey);
  return status;
}

}  // namespace stucco
