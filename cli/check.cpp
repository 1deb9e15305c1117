// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/verbs/check.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <iostream>

#include "cli/internal/json_output.h"
#include "cli/program.h"
#include "pipeline/engine/engine.h"

namespace stucco {
namespace {

Json ToJson(const CheckResult& result) {
  Json problems = Json::array(), needs = Json::array(), left_out = Json::array();
  for (const PhotoProblem& problem : result.photos.problems) {
    left_out.push_back({{"path", problem.path}, {"why", problem.why}});
  }
  for (const CheckProblem& problem : result.problems) {
    problems.push_back({{"fatal", problem.fatal},
                        {"kind", KindName(problem.kind)},
                        {"what", problem.what},
                        {"remedy", problem.remedy}});
  }
  for (const StageNeed& need : result.needs) {
    needs.push_back({{"stage", need.stage},
                     {"wall_s", need.wall_s},
                     {"disk_mb", need.disk_mb},
                     {"memory_mb", need.memory_mb}});
  }
  return {{"ok", result.ok()},
          {"problems", problems},
          {"photos",
           {{"count", result.photos.photos},
            {"megapixels", result.photos.megapixels},
            {"other_files", result.photos.other_files},
            {"left_out", left_out}}},
          {"estimates", needs},
          {"threads", result.threads},
          {"memory_limit_mb", result.memory_limit_mb},
          {"available_memory_mb", result.available_memory_mb},
          {"free_disk_mb", result.free_disk_mb}};
}

void Print(const CheckResult& result, const std::string& survey) {
  std::cout << fmt::format("{} photos, {:.0f} megapixels; {} other files\n", result.photos.photos,
                           result.photos.megapixels, result.photos.other_files);
  std::cout << fmt::format("{} threads, {} of memory free, {} of disk free\n\n", result.threads,
                           MemoryText(result.available_memory_mb), MemoryText(result.free_disk_mb));
  std::cout << "Rough needs of a run from the start:\n  stage    time          disk      memory\n";
  double wall_s = 0, disk_mb = 0;
  for (const StageNeed& need : result.needs) {
    std::cout << fmt::format("  {:<8} {:<13} {:<9} {}\n", need.stage, DurationText(need.wall_s),
                             MemoryText(need.disk_mb), MemoryText(need.memory_mb));
    wall_s += need.wall_s;
    disk_mb += need.disk_mb;
  }
  std::cout << fmt::format("  together {:<13} {}\n\n", DurationText(wall_s), MemoryText(disk_mb));
  for (const PhotoProblem& problem : result.photos.problems) {
    std::cout << fmt::format("left out: {}\n", problem.why);
  }
  for (const CheckProblem& problem : result.problems) {
    std::cout << fmt::format("{}: {}\n  {}\n", problem.fatal ? "problem" : "warning", problem.what,
                             problem.remedy);
  }
  std::cout << (result.ok() ? fmt::format("Ready. Next: stucco run {}\n", ShellWord(survey))
                            : "Not ready.\n");
}

int CheckAndPrint(const Program& program) {
  const CommonOptions& common = program.common;
  Settings settings = LoadSettings(common.survey, program.table, {});
  if (common.threads > 0) {
    settings.run.threads = common.threads;
  }
  if (common.memory_limit_gb > 0) {
    settings.run.memory_limit_gb = common.memory_limit_gb;
  }
  std::vector<std::string> stages;
  for (const Stage& stage : program.table) {
    stages.push_back(stage.name);
  }
  const CheckResult result = Check(common.survey, program.table, settings, stages);
  if (common.json) {
    PrintJson(ToJson(result));
  } else {
    Print(result, common.survey);
  }
  return result.ok() ? 0 : ExitCode(result.problems.front().kind);
}

}  // namespace

void AddCheck(CLI::App& app, Program& program) {
  CLI::App& verb = AddVerb(
      app, {"check", "Look for problems before hours of work; estimate disk, memory and time",
            "stucco check castle\nstucco check castle --json", kEverydayGroup});
  AddSurveyArgument(verb, program);
  verb.callback([&program] { program.action = [&program] { return CheckAndPrint(program); }; });
}

}  // namespace stucco
