// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/verbs/lint.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <iostream>

#include "cli/internal/json_output.h"
#include "cli/program.h"

namespace stucco {
namespace {

int Lint(const Program& program, const std::string& mission) {
  const std::vector<MissionFault> faults = LintMission(mission);
  if (program.common.json) {
    Json list = Json::array();
    for (const MissionFault& fault : faults) {
      list.push_back({{"element", fault.element}, {"rule", fault.rule}, {"text", fault.text}});
    }
    PrintJson(Json{{"mission", mission}, {"faults", list}});
  } else {
    for (const MissionFault& fault : faults) {
      std::cout << fmt::format("{} | {} | {}\n", fault.element, fault.rule, fault.text);
    }
    if (!program.common.quiet) {
      std::cout << fmt::format(
          "{}: {}\n", mission,
          faults.empty() ? "no faults found" : fmt::format("{} faults", faults.size()));
    }
  }
  constexpr int kFaulty = 4;  // a quality gate was not met
  return faults.empty() ? 0 : kFaulty;
}

}  // namespace

void AddLint(CLI::App& app, Program& program) {
  CLI::App& verb = AddVerb(app, {"lint", "Check a DJI mission file before it goes to the drone",
                                 "stucco lint survey/plan/mission.kmz", kTransferGroup});
  auto mission = std::make_shared<std::string>();
  verb.add_option("mission", *mission, "KMZ with wpmz/template.kml and wpmz/waylines.wpml")
      ->type_name("FILE")
      ->required();
  verb.callback([&program, mission] {
    program.action = [&program, mission] { return Lint(program, *mission); };
  });
}

}  // namespace stucco
