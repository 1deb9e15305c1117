// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/verbs/run.h"

#include "pipeline/engine/manifest.h"
#include "pipeline/engine/work_folder.h"
#include "pipeline/verbs/check.h"

namespace stucco {
namespace {

// Stages whose results were imported open no photos, of which a scan with a map has none.
std::vector<std::string> WithoutImported(const std::filesystem::path& survey,
                                         std::vector<std::string> stages) {
  std::erase_if(stages, [&](const std::string& stage) {
    const auto manifest = ReadManifest(WorkFolder(survey).Manifest(stage)).manifest;
    return manifest && !manifest->imported_from.empty();
  });
  return stages;
}

}  // namespace

RunResult RunSurvey(const std::filesystem::path& survey, const StageTable& table,
                    RunOptions options, Console& console, const Platform& platform) {
  options.precheck = [&, force = options.force](const Settings& settings,
                                                const std::vector<std::string>& stages,
                                                const WarnUser& warn) {
    const CheckResult check =
        Check(survey, table, settings, force ? stages : WithoutImported(survey, stages));
    for (const CheckProblem& problem : check.problems) {
      if (!problem.fatal) {
        warn(problem.what, problem.remedy);
      }
    }
    ThrowIfFatal(check);
  };
  return Run(survey, table, options, console, platform);
}

}  // namespace stucco
