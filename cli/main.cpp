// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <iostream>
#include <string>
#include <vector>

#include "cli/library_logs.h"
#include "cli/program.h"
#include "cli/suggest.h"
#include "pipeline/default_stages.h"
#include "pipeline/engine/engine.h"
#include "survey/keep_memory.h"

namespace {

constexpr char kAbout[] =
    "Stucco plans a drone survey from a map of buildings, and turns a folder of building photos "
    "into\n"
    "a textured planar 3D model with a quality report for every facade. It continues where it was\n"
    "stopped and repeats only what changed.";

constexpr char kFooter[] =
    "Start here:\n"
    "  stucco plan town.geojson -o my-survey       plan a flight; or, with photos at hand,\n"
    "  stucco init my-survey --photos my-photos    create a survey\n"
    "  stucco run my-survey                        make everything\n"
    "  stucco status my-survey                     see what is done and what to do next\n"
    "\n"
    "stucco VERB --help explains a verb. Exit codes: 0 done, 1 a stage failed, 2 wrong usage,\n"
    "3 bad input, 4 lint found faults, 5 out of disk or memory, 130 interrupted.";

void AddVerbs(CLI::App& app, stucco::Program& program) {
  stucco::AddPlan(app, program);
  stucco::AddSimulate(app, program);
  stucco::AddInit(app, program);
  stucco::AddCheck(app, program);
  stucco::AddRun(app, program);
  stucco::AddRetexture(app, program);
  stucco::AddStatus(app, program);
  stucco::AddStageVerbs(app, program);
  stucco::AddImport(app, program);
  stucco::AddExport(app, program);
  stucco::AddEvaluate(app, program);
  stucco::AddLint(app, program);
  stucco::AddOptions(app, program);
  stucco::AddCompletion(app, program);
  for (CLI::App* verb : app.get_subcommands(nullptr)) {
    stucco::AddCommonOptions(*verb, program.common);
  }
}

bool AsksForJson(const std::vector<std::string>& words) {
  return std::find(words.begin(), words.end(), "--json") != words.end();
}

std::string CommandLine(const std::vector<std::string>& words) {
  std::string text = "stucco";
  for (const std::string& word : words) {
    text += " " + stucco::ShellWord(word);
  }
  return text;
}

std::vector<std::string> Without(const std::string& flag, std::vector<std::string> words) {
  std::erase(words, flag);
  return words;
}

int Main(const std::vector<std::string>& words) {
  stucco::SilenceLibraryLogs();
  stucco::KeepFreedMemory();
  stucco::Program program;
  program.table = stucco::DefaultStages();
  program.command_line = CommandLine(words);
  program.continue_line = CommandLine(Without("--force", words));
  CLI::App app(kAbout, "stucco");
  app.footer(kFooter);
  app.set_help_flag("-h,--help", "Print this help and end");
  app.set_version_flag("-V,--version", "stucco " + stucco::ProgramVersion());
  app.require_subcommand(1);
  app.get_formatter()->column_width(34);
  app.get_formatter()->label("SUBCOMMAND", "VERB");
  AddVerbs(app, program);
  try {
    app.parse(std::vector<std::string>(words.rbegin(), words.rend()));  // CLI11 takes them reversed
  } catch (const CLI::Success& e) {
    return app.exit(e);  // --help, --version
  } catch (const CLI::ParseError& e) {
    if (words.empty()) {
      std::cout << app.help();
      return stucco::ExitCode(stucco::ErrorKind::kUsage);
    }
    const std::string what = stucco::IsUnknownVerb(app, words.front())
                                 ? fmt::format("there is no verb \"{}\"", words.front())
                                 : e.what();
    throw stucco::Error(stucco::ErrorKind::kUsage, what, stucco::SuggestUsage(app, words));
  }
  return program.action();
}

// What was printed has to arrive: a script that reads a cut result must not take it for whole.
void RequireWrittenOutput() {
  std::cout.flush();
  if (!std::cout || std::ferror(stdout) != 0) {
    throw stucco::Error(stucco::ErrorKind::kOutOfResource,
                        "standard output: the result could not be written whole",
                        "make room where it goes, and type the same command again");
  }
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<std::string> words(argv + 1, argv + argc);
  try {
    const int exit_code = Main(words);
    if (exit_code == 0) {
      RequireWrittenOutput();
    }
    return exit_code;
  } catch (...) {
    const stucco::Error error = stucco::AsError(std::current_exception());
    stucco::PrintError(error, AsksForJson(words));
    return stucco::ExitCode(error.kind());
  }
}
