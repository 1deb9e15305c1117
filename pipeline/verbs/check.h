// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "pipeline/engine/settings.h"
#include "pipeline/verbs/photos.h"
#include "survey/error.h"

namespace stucco {

struct CheckProblem {
  ErrorKind kind = ErrorKind::kBadInput;
  bool fatal = true;  // false: the work can begin all the same
  std::string what;
  std::string remedy;
};

// What a stage will need, roughly.
struct StageNeed {
  std::string stage;
  double wall_s = 0;
  double disk_mb = 0;
  double memory_mb = 0;
};

struct CheckResult {
  std::vector<CheckProblem> problems;  // fatal ones first
  PhotoFolder photos;                  // with the files that will be left out
  std::vector<StageNeed> needs;        // of the stages that were asked about
  int threads = 1;
  double memory_limit_mb = 0;
  double available_memory_mb = 0;
  double free_disk_mb = 0;

  bool ok() const;
};

// Looks at everything that can be known before hours of work: the photo folder, disk, memory, and
// how long each of `stages` will take. Settings were checked when they were read. Writes nothing.
CheckResult Check(const std::filesystem::path& survey, const StageTable& table,
                  const Settings& settings, const std::vector<std::string>& stages);

// Throws one Error with all fatal problems.
void ThrowIfFatal(const CheckResult& result);

}  // namespace stucco
