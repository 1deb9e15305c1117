// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <iostream>

#include "cli/internal/json_output.h"
#include "cli/program.h"
#include "pipeline/engine/engine.h"

namespace stucco {
namespace {

Json ToJson(const StageReport& report) {
  const StageStatus status = ToStatus(report.stage, report.assessment);
  Json json = {{"stage", report.stage},
               {"state", status.state},
               {"reasons", report.assessment.reasons},
               {"remedy", status.remedy}};
  if (status.wall_s >= 0) {
    json["wall_s"] = status.wall_s;
    json["cpu_s"] = status.cpu_s;
    json["cores"] = UsageOf(report.assessment)->cores;
    json["peak_memory_mb"] = status.peak_memory_mb;
  }
  if (report.assessment.manifest) {
    const Manifest& manifest = *report.assessment.manifest;
    json["imported_from"] = manifest.imported_from;
    Json units = Json::object();
    for (const auto& [kind, count] : manifest.units) {
      units[kind] = {{"computed", count.computed}, {"reused", count.reused}};
    }
    json["units"] = units;
  }
  return json;
}

Json ToJson(const SurveyStatus& status, const std::string& survey) {
  Json stages = Json::array();
  for (const StageReport& report : status.stages) {
    stages.push_back(ToJson(report));
  }
  Json json = {{"survey", survey}, {"stages", stages}, {"running", nullptr}, {"next", status.next}};
  if (status.running) {
    json["running"] = {{"pid", status.running->pid},
                       {"host", status.running->host},
                       {"started", status.running->started},
                       {"command", status.running->command}};
  }
  return json;
}

std::string Why(const StageReport& report) {
  const auto& manifest = report.assessment.manifest;
  if (manifest && !manifest->imported_from.empty()) {
    return "imported from " + manifest->imported_from;
  }
  return JoinReasons(report.assessment.reasons);
}

std::string Row(const StageReport& report) {
  std::string time = "-", cpu = "-", busy = "-", memory = "-";
  const Usage* usage = UsageOf(report.assessment);
  if (usage != nullptr && usage->wall_s > 0) {
    time = DurationText(usage->wall_s);
    cpu = DurationText(usage->cpu_s);
    memory = MemoryText(usage->peak_memory_mb);
    if (const std::string cores = CoresText(*usage); !cores.empty()) busy = cores;
  }
  return fmt::format("{:<8} {:<8} {:<13} {:<13} {:<15} {}\n", report.stage,
                     Name(report.assessment.state), time, cpu, busy, memory);
}

void Print(const SurveyStatus& status) {
  std::cout << "stage    state    time          CPU           busy            memory\n";
  for (const StageReport& report : status.stages) {
    std::cout << Row(report);
    if (const std::string why = Why(report); !why.empty()) {
      std::cout << "         " << why << "\n";
    }
  }
  std::cout << "Next: " << status.next << "\n";
}

}  // namespace

void AddStatus(CLI::App& app, Program& program) {
  CLI::App& verb = AddVerb(
      app, {"status", "Say what is done, stale (and why), missing or failed; what to do next",
            "stucco status castle\nstucco status castle --json", kEverydayGroup});
  AddSurveyArgument(verb, program);
  verb.callback([&program] {
    program.action = [&program] {
      const SurveyStatus status = GetStatus(program.common.survey, program.table, RealPlatform());
      if (program.common.json) {
        PrintJson(ToJson(status, program.common.survey));
      } else {
        Print(status);
      }
      return 0;
    };
  });
}

}  // namespace stucco
