// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/engine/assess.h"
#include "pipeline/engine/lock.h"

namespace stucco {

struct StageReport {
  std::string stage;
  std::string title;
  Assessment assessment;
};

struct SurveyStatus {
  std::vector<StageReport> stages;  // of the whole table
  std::optional<LockOwner> running;
  std::string next;  // command to type, or what to open when all is done
};

// Where every stage stands and why. Computes nothing and changes no output. Throws Error when
// survey.toml is missing or wrong. Requires FindProblem(table) to find nothing.
SurveyStatus GetStatus(const std::filesystem::path& survey, const StageTable& table,
                       const Platform& platform);

}  // namespace stucco
