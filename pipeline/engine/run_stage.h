// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "pipeline/engine/console.h"
#include "pipeline/engine/manifest.h"
#include "pipeline/engine/platform.h"
#include "pipeline/engine/stages.h"

namespace stucco {

class EventLog;

struct StageJob {
  const Stage& stage;
  const BoundStage& bound;
  SurveyPaths paths;
  Fingerprint fingerprint;  // of what the stage is about to read
  std::vector<StageStatus> statuses;
  int threads = 1;
  uint64_t memory_limit_bytes = uint64_t{4} << 30;
};

// Runs one stage in a scratch folder and, when it succeeds, puts its outputs in place, then its
// manifest, then removes the units it no longer needs. When it fails, the old outputs stay and the
// failure is recorded. Returns the manifest, or the failure in `failure`. Throws Error only when
// interrupted.
struct StageRunResult {
  std::optional<Manifest> manifest;
  std::optional<Failure> failure;
};
StageRunResult RunStage(const StageJob& job, const Platform& platform, Console& console,
                        EventLog& events, HashCache& hashes);

// Hashes of all files below survey/<stage>, by path relative to the survey.
std::map<std::string, std::string> HashOutputs(const std::filesystem::path& survey,
                                               const std::string& stage, int threads,
                                               HashCache& hashes);

}  // namespace stucco
