// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <CLI/CLI.hpp>

#include "cli/program.h"

// In place of simulate.cpp and evaluate.cpp in programs that are built without them.
namespace stucco {
namespace {

void AddMissing(CLI::App& app, Program& program, const std::string& name) {
  CLI::App& verb = AddVerb(
      app, {name, "Not in this program, which was built without the virtual drone",
            "cmake -DSTUCCO_SIMULATE=ON builds one that knows stucco " + name, kEverydayGroup});
  verb.allow_extras();
  verb.callback([&program, name] {
    program.action = [name]() -> int {
      throw Error(ErrorKind::kUsage, name + ": this program was built without it",
                  "build one with cmake -DSTUCCO_SIMULATE=ON");
    };
  });
}

}  // namespace

void AddSimulate(CLI::App& app, Program& program) {
  AddMissing(app, program, "simulate");
}

void AddEvaluate(CLI::App& app, Program& program) {
  AddMissing(app, program, "evaluate");
}

}  // namespace stucco
