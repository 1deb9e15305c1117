// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/engine/console.h"
#include "pipeline/engine/manifest.h"
#include "pipeline/engine/platform.h"
#include "pipeline/engine/run_options.h"
#include "pipeline/engine/stages.h"

namespace stucco {

enum class StageAction {
  kUpToDate,  // nothing to do
  kRan,       // and succeeded
  kFailed,
  kInterrupted,  // begun and not ended; what it finished is kept
  kBlocked,      // not run, because a stage that it needs failed
  kSkipped,      // not asked for
};

std::string Name(StageAction action);  // "up_to_date", "ran", "failed", ...

struct StageOutcome {
  std::string stage;
  StageAction action = StageAction::kSkipped;
  std::vector<std::string> reasons;  // why it ran, or why it could not
  std::optional<Failure> failure;
  Usage usage;  // of this run; zero when it did not run
  std::map<std::string, UnitCount> units;
};

struct RunResult {
  std::vector<StageOutcome> stages;  // of the whole table
  int exit_code = 0;
  bool interrupted = false;
};

// Brings a survey up to date: every selected stage whose manifest no longer describes its options,
// inputs and outputs runs again, in order. After a failure only stages that report failures still
// run, also when they were not asked for. `force` forgets the manifests and checkpoints of its
// stages at the start, so that a run after an interruption continues without it. Throws Error for
// everything that is wrong before work starts: another run, settings, what `precheck` finds.
// Requires FindProblem(table) to find nothing.
RunResult Run(const std::filesystem::path& survey, const StageTable& table,
              const RunOptions& options, Console& console, const Platform& platform);

}  // namespace stucco
