// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "pipeline/engine/stages.h"

namespace stucco {

// Settings of the run itself; none of them changes a result.
struct RunSettings {
  int threads = 0;  // 0: all cores
  double memory_limit_gb = 4;
};

void Describe(OptionTable& table, RunSettings& settings);

// Threads to compute on, with "all cores" resolved; at least 1.
int ResolvedThreads(const RunSettings& settings);

// survey.toml, read and checked.
struct Settings {
  std::filesystem::path photos;  // absolute
  RunSettings run;
  std::map<std::string, BoundStage> stages;
};

// Reads survey/survey.toml and applies `overrides` ("calib.max_image_px=1600") on top. Finds all
// problems before it throws one Error that lists them, a line each, with file, line and the
// nearest known name: kUsage for options, kBadInput when the file is missing or is not TOML.
Settings LoadSettings(const std::filesystem::path& survey, const StageTable& table,
                      const std::vector<std::string>& overrides);

// The text of a new survey.toml: every option with its default, its range and what it does.
std::string SettingsTemplate(const StageTable& table, const std::string& photos);

// The same as tables in Markdown, a section per stage (docs/options.md).
std::string OptionsAsMarkdown(const StageTable& table);

// "in [1, 64]", "one of auto, gps, none"; empty where anything goes.
std::string AllowedValues(const Option& option);

}  // namespace stucco
