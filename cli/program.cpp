// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/program.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <iostream>
#include <sstream>

#include "cli/internal/json_output.h"
#include "pipeline/engine/engine.h"

namespace stucco {
namespace {

std::string Indented(const std::string& text) {
  std::istringstream lines(text);
  std::string result;
  for (std::string line; std::getline(lines, line);) {
    result += "  " + line + "\n";
  }
  return result;
}

}  // namespace

Verbosity CommonOptions::verbosity() const {
  if (quiet) {
    return Verbosity::kQuiet;
  }
  return verbose ? Verbosity::kVerbose : Verbosity::kNormal;
}

CLI::App& AddVerb(CLI::App& app, const VerbText& text) {
  CLI::App& verb = *app.add_subcommand(text.name, text.help);
  verb.group(text.group);
  verb.footer("Examples:\n" + Indented(text.examples));
  return verb;
}

void AddCommonOptions(CLI::App& verb, CommonOptions& common) {
  const std::string group = "Options of every verb";
  verb.add_flag("--json", common.json, "Print the result as JSON on standard output")->group(group);
  verb.add_option("--threads", common.threads,
                  "Threads to compute on; default: as survey.toml says")
      ->type_name("N")
      ->check(CLI::Range(1, 1024).description(""))
      ->group(group);
  verb.add_option("--memory-limit", common.memory_limit_gb,
                  "Memory in GiB to plan the work for; default: as survey.toml says")
      ->type_name("GIB")
      ->check(CLI::Range(0.25, 4096.0).description(""))
      ->group(group);
  verb.add_flag("-q,--quiet", common.quiet, "Only warnings and errors on standard error")
      ->group(group);
  verb.add_flag("-v,--verbose", common.verbose, "More detail on standard error")->group(group);
  verb.set_help_flag("-h,--help", "Print this help and end")->group(group);
}

void AddSurveyArgument(CLI::App& verb, Program& program) {
  verb.add_option("survey", program.common.survey, "Survey folder; the current one by default")
      ->type_name("FOLDER");
}

void PrintError(const Error& error, bool json) {
  std::cerr << "stucco: " << error.what() << "\n" << Indented(error.remedy());
  if (json) {
    const Json object = {{"error", error.what()},
                         {"remedy", error.remedy()},
                         {"kind", KindName(error.kind())},
                         {"exit_code", ExitCode(error.kind())}};
    PrintJson(object);
  }
}

}  // namespace stucco
