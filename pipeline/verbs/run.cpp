// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/verbs/run.h"

#include "pipeline/verbs/check.h"

namespace stucco {

RunResult RunSurvey(const std::filesystem::path& survey, const StageTable& table,
                    RunOptions options, Console& console, const Platform& platform) {
  options.precheck = [&](const Settings& settings, const std::vector<std::string>& stages,
                         const WarnUser& warn) {
    const CheckResult check = Check(survey, table, settings, stages);
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
