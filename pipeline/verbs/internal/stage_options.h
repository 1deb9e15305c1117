// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include "pipeline/engine/settings.h"
#include "pipeline/engine/stages.h"
#include "survey/options.h"

namespace stucco {

// What a stage's results were made with, to override the settings with: options given for one run
// count too. None where the stage has not run.
std::vector<std::string> OptionsAsMade(const std::filesystem::path& survey, const StageTable& table,
                                       const std::string& stage);

// A stage's options as the settings have them, for verbs that do a part of its work. Requires the
// settings of a table that has the stage.
template <typename Options>
Options OptionsOf(const Settings& settings, const std::string& stage) {
  Options options;
  OptionTable table(stage);
  Describe(table, options);
  for (const Option& from : settings.stages.at(stage).options.options()) {
    const Option* to = table.Find(from.name);
    std::visit([&](auto* value) { *std::get<decltype(value)>(to->value) = *value; }, from.value);
  }
  return options;
}

}  // namespace stucco
