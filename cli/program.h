// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "pipeline/engine/engine.h"
#include "survey/error.h"

namespace CLI {
class App;
}

namespace stucco {

// What every verb understands.
struct CommonOptions {
  std::string survey = ".";
  bool json = false;
  bool quiet = false;
  bool verbose = false;
  int threads = 0;             // 0: as survey.toml says
  double memory_limit_gb = 0;  // 0: as survey.toml says

  Verbosity verbosity() const;
};

// The program while its arguments are read: a verb's Add function registers it with CLI11 and sets
// `action` when it is chosen.
struct Program {
  StageTable table;
  CommonOptions common;
  std::string command_line;     // as typed, for the lock and the event log
  std::string continue_line;    // what continues it: as typed without --force, which it has done
  std::function<int()> action;  // returns the exit code; may throw Error
};

// `examples` are shown under the verb's help, a line each; `group` is its heading in the overview.
struct VerbText {
  std::string name, help, examples, group;
};
inline constexpr char kEverydayGroup[] = "Every day";
inline constexpr char kStageGroup[] = "One stage, with the stages it needs";
inline constexpr char kTransferGroup[] = "From and to other programs";
inline constexpr char kProgramGroup[] = "About the program";
CLI::App& AddVerb(CLI::App& app, const VerbText& text);
// The options that every verb has, after its own.
void AddCommonOptions(CLI::App& verb, CommonOptions& common);
// The survey folder as the verb's first argument; the current folder when it is left out.
void AddSurveyArgument(CLI::App& verb, Program& program);

// One function per file of the same name.
void AddPlan(CLI::App& app, Program& program);
void AddSimulate(CLI::App& app, Program& program);
void AddLint(CLI::App& app, Program& program);
void AddInit(CLI::App& app, Program& program);
void AddCheck(CLI::App& app, Program& program);
void AddRetexture(CLI::App& app, Program& program);
void AddRun(CLI::App& app, Program& program);
void AddStageVerbs(CLI::App& app, Program& program);
void AddStatus(CLI::App& app, Program& program);
void AddImport(CLI::App& app, Program& program);
void AddExport(CLI::App& app, Program& program);
void AddEvaluate(CLI::App& app, Program& program);
void AddOptions(CLI::App& app, Program& program);
void AddCompletion(CLI::App& app, Program& program);

// Runs the pipeline and prints what a run prints; `run` and every stage verb end here.
int RunAndPrint(const Program& program, RunOptions options);
// Runs the pipeline before something else that prints; what a run prints only where it failed.
int RunBefore(const Program& program, RunOptions options, const Platform& platform);
// Runs the pipeline and makes an epoch of the survey again.
int RunAndRetexture(const Program& program, RunOptions options, const std::string& epoch);

// An error as people see it, on stderr, and with --json as an object on stdout.
void PrintError(const Error& error, bool json);

}  // namespace stucco
