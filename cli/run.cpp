// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/verbs/run.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <iostream>

#include "cli/internal/json_output.h"
#include "cli/interrupt.h"
#include "cli/program.h"
#include "pipeline/engine/engine.h"
#include "survey/survey_folder.h"

namespace stucco {
namespace {

Json ToJson(const StageOutcome& outcome) {
  Json json = {
      {"stage", outcome.stage}, {"action", Name(outcome.action)}, {"reasons", outcome.reasons}};
  if (outcome.failure) {
    json["failure"] = {{"kind", outcome.failure->kind},
                       {"why", outcome.failure->why},
                       {"remedy", outcome.failure->remedy}};
  }
  if (outcome.action == StageAction::kRan || outcome.failure) {
    json["wall_s"] = outcome.usage.wall_s;
    json["cpu_s"] = outcome.usage.cpu_s;
    json["cores"] = outcome.usage.cores;
    json["peak_memory_mb"] = outcome.usage.peak_memory_mb;
  }
  Json units = Json::object();
  for (const auto& [kind, count] : outcome.units) {
    units[kind] = {{"computed", count.computed}, {"reused", count.reused}};
  }
  json["units"] = units;
  return json;
}

// Nothing when this run had nothing to do with the report.
std::string ReportPath(const RunResult& result, const std::string& survey) {
  for (const StageOutcome& outcome : result.stages) {
    if (outcome.stage == "report" &&
        (outcome.action == StageAction::kRan || outcome.action == StageAction::kUpToDate)) {
      return (std::filesystem::path(survey) / kReportFile).string();
    }
  }
  return {};
}

void PrintEnd(const RunResult& result, const Program& program) {
  const CommonOptions& common = program.common;
  const std::string report = ReportPath(result, common.survey);
  if (common.json) {
    Json stages = Json::array();
    for (const StageOutcome& outcome : result.stages) {
      stages.push_back(ToJson(outcome));
    }
    const Json json = {{"survey", common.survey},
                       {"exit_code", result.exit_code},
                       {"interrupted", result.interrupted},
                       {"stages", stages},
                       {"report", report}};
    PrintJson(json);
    return;
  }
  if (result.interrupted) {
    std::cerr << "Interrupted. To go on from here: " << program.continue_line << "\n";
  } else if (result.exit_code != 0) {
    std::cerr << "Once that is mended: " << program.continue_line << "\n";
  }
  if (!report.empty() && !common.quiet) {
    std::cout << "Report: " << report << "\n";
  }
}

void AddSet(CLI::App& verb, std::vector<std::string>& set) {
  verb.add_option("--set", set,
                  "Set an option for this run only, as in calib.max_image_px=1600; may be repeated")
      ->type_name("STAGE.OPTION=VALUE")
      ->expected(1)
      ->take_all();
}

constexpr char kTextureStage[] = "texture";  // the one with epochs

constexpr char kForceHelp[] =
    "Forget what is up to date and all checkpoints, and run everything again";

// --max-image-px for calib.max_image_px; the values end up in `options.set`.
void AddStageOptions(CLI::App& verb, const Stage& stage,
                     const std::shared_ptr<std::vector<std::string>>& set) {
  const BoundStage bound = stage.bind();
  for (const Option& option : bound.options.options()) {
    std::string dashed = option.name;
    std::replace(dashed.begin(), dashed.end(), '_', '-');
    const std::string allowed = AllowedValues(option);
    verb.add_option_function<std::string>(
            "--" + dashed,
            [set, section = stage.name, name = option.name](const std::string& value) {
              set->push_back(fmt::format("{}.{}={}", section, name, value));
            },
            fmt::format("{} ({}default {})", option.help, allowed.empty() ? "" : allowed + "; ",
                        ValueAsToml(option)))
        ->type_name("VALUE")
        ->group("Settings of " + stage.name + ", for this run only (survey.toml keeps them)");
  }
}

void AddStageVerb(CLI::App& app, Program& program, const Stage& stage) {
  CLI::App& verb = AddVerb(
      app, {stage.name, "Make " + stage.title,
            fmt::format("stucco {} castle\nstucco {} castle --force", stage.name, stage.name),
            kStageGroup});
  AddSurveyArgument(verb, program);
  auto options = std::make_shared<RunOptions>();
  auto set = std::make_shared<std::vector<std::string>>();
  options->goal = stage.name;
  verb.add_flag(
      "--force", options->force,
      fmt::format("Forget the results and checkpoints of {} and run it again", stage.name));
  AddSet(verb, options->set);
  auto epoch = std::make_shared<std::string>();
  if (stage.name == kTextureStage) {
    verb.add_option("--epoch", *epoch,
                    "Then make this epoch of stucco retexture again, from its photos, on the "
                    "model and the pictures as they are now")
        ->type_name("NAME");
  }
  AddStageOptions(verb, stage, set);
  verb.callback([&program, options, set, epoch] {
    options->set.insert(options->set.end(), set->begin(), set->end());
    program.action = [&program, options, epoch] {
      return epoch->empty() ? RunAndPrint(program, *options)
                            : RunAndRetexture(program, *options, *epoch);
    };
  });
}

RunResult Run(const Program& program, RunOptions options, const Platform& platform) {
  options.threads = program.common.threads;
  options.memory_limit_gb = program.common.memory_limit_gb;
  options.command = program.command_line;
  Console console = Console::ForStderr(program.common.verbosity());
  return RunSurvey(program.common.survey, program.table, options, console, platform);
}

}  // namespace

int RunAndPrint(const Program& program, RunOptions options) {
  const RunResult result = Run(program, std::move(options), CatchInterrupts());
  PrintEnd(result, program);
  return result.exit_code;
}

int RunBefore(const Program& program, RunOptions options, const Platform& platform) {
  const RunResult result = Run(program, std::move(options), platform);
  if (result.exit_code != 0) PrintEnd(result, program);
  return result.exit_code;
}

void AddRun(CLI::App& app, Program& program) {
  CLI::App& verb = AddVerb(app, {"run", "Bring a survey up to date; go on wherever it was stopped",
                                 "stucco run castle\n"
                                 "stucco run castle --until calib\n"
                                 "stucco run castle --set dense.max_image_px=800",
                                 kEverydayGroup});
  AddSurveyArgument(verb, program);
  auto options = std::make_shared<RunOptions>();
  verb.add_option("--until", options->until, "Last stage to run")->type_name("STAGE");
  verb.add_option("--from", options->from, "First stage to run; those before are taken as they are")
      ->type_name("STAGE");
  verb.add_flag("--force", options->force, kForceHelp);
  AddSet(verb, options->set);
  verb.callback([&program, options] {
    program.action = [&program, options] { return RunAndPrint(program, *options); };
  });
}

void AddStageVerbs(CLI::App& app, Program& program) {
  for (const Stage& stage : program.table) {
    AddStageVerb(app, program, stage);
  }
}

}  // namespace stucco
