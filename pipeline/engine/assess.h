// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/engine/manifest.h"

namespace stucco {

enum class StageState { kDone, kStale, kMissing, kFailed };

std::string Name(StageState state);  // "done", "stale", "missing", "failed"

// Where a stage stands, and why it is not done.
struct Assessment {
  StageState state = StageState::kMissing;
  std::vector<std::string> reasons;  // sentences; empty when done
  std::optional<Manifest> manifest;  // of the outputs that are there, when readable
  std::optional<Failure> failure;    // of the last attempt, unless the stage is done
};

// A stage is done when its manifest still describes its options, its inputs and its outputs, all
// by content. An imported stage is done as long as its outputs are what was imported. Reads output
// files through `hashes`.
Assessment Assess(const Stage& stage, const SurveyPaths& paths, const Fingerprint& now, int threads,
                  HashCache& hashes);

// A stage whose inputs are as they were is still not up to date when a stage that it needs will run
// again: adds "calib will change", by the states of the stages before it. Imported results and
// reports of a failure stand on their own.
void ApplyNeeds(const Stage& stage, const std::map<std::string, StageState>& states,
                Assessment& assessment);

// The first few reasons as one line: "a; b; and 3 more".
std::string JoinReasons(const std::vector<std::string>& reasons);

// What the attempt that says how the stage stands took: the last one when it failed, else the one
// that made the outputs. Null when there was none.
const Usage* UsageOf(const Assessment& assessment);

// For StageContext::statuses and for people.
StageStatus ToStatus(const std::string& stage, const Assessment& assessment);

}  // namespace stucco
