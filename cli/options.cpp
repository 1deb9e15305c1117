// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <CLI/CLI.hpp>
#include <iostream>

#include "cli/internal/json_output.h"
#include "cli/program.h"
#include "pipeline/engine/engine.h"

namespace stucco {
namespace {

Json ToJson(const OptionTable& table) {
  Json options = Json::array();
  for (const Option& option : table.options()) {
    options.push_back({{"name", option.name},
                       {"default", ValueAsToml(option)},
                       {"allowed", AllowedValues(option)},
                       {"help", option.help},
                       {"affects_result", option.affects_result}});
  }
  return {{"section", table.section()}, {"options", options}};
}

Json AllAsJson(const StageTable& table) {
  RunSettings run;
  OptionTable run_table("run");
  Describe(run_table, run);
  Json sections = Json::array({ToJson(run_table)});
  for (const Stage& stage : table) {
    sections.push_back(ToJson(stage.bind().options));
  }
  return sections;
}

}  // namespace

void AddOptions(CLI::App& app, Program& program) {
  CLI::App& verb =
      AddVerb(app, {"options", "List every setting of survey.toml, as Markdown or JSON",
                    "stucco options | less\nstucco options --json", kProgramGroup});
  verb.callback([&program] {
    program.action = [&program] {
      if (program.common.json) {
        PrintJson(AllAsJson(program.table));
      } else {
        std::cout << OptionsAsMarkdown(program.table);
      }
      return 0;
    };
  });
}

}  // namespace stucco
