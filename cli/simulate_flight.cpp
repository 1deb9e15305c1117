// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/simulate_flight.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <string_view>

#include "cli/internal/json_output.h"
#include "cli/interrupt.h"
#include "pipeline/engine/engine.h"
#include "pipeline/verbs/init.h"
#include "pipeline/verbs/simulate.h"
#include "simulate/flight/flight_folder.h"
#include "simulate/flight/fly.h"

namespace stucco {
namespace {

namespace fs = std::filesystem;

// The simulator puts the photos where the survey looks for them.
static_assert(std::string_view(kWaitingPhotos) == simulate::kPhotoFolder);

constexpr char kGroup[] = "The flight that is simulated";

// --gps-sigma and --gps-sigma-m for gps_sigma_m.
std::string OptionNames(const std::string& name, bool is_flag) {
  std::string dashed = name;
  std::replace(dashed.begin(), dashed.end(), '_', '-');
  std::string names = "--" + dashed;
  if (is_flag) return names + ",!--no-" + dashed;
  for (const std::string unit : {"-m", "-px", "-deg"}) {
    if (dashed.ends_with(unit)) {
      return "--" + dashed.substr(0, dashed.size() - unit.size()) + "," + names;
    }
  }
  return names;
}

simulate::FlightOptions ReadOptions(const std::vector<std::string>& set) {
  simulate::FlightOptions options;
  OptionTable table("simulate");
  simulate::Describe(table, options);
  std::vector<std::string> problems;
  for (const std::string& item : set) {
    const size_t equals = item.find('=');
    const std::string problem =
        SetOptionFromText(table, item.substr(0, equals), item.substr(equals + 1));
    if (!problem.empty()) problems.push_back(problem);
  }
  if (!problems.empty()) {
    throw Error(ErrorKind::kUsage, fmt::format("{}", fmt::join(problems, "\n")),
                "stucco simulate --help lists the options");
  }
  return options;
}

simulate::FlyRequest RequestOf(const FlightArguments& arguments, int threads) {
  simulate::FlyRequest request;
  request.scene = arguments.scene;
  request.plan = arguments.plan;
  request.survey = arguments.survey;
  request.threads = threads > 0 ? threads : AvailableCores();
  request.reading.unit_m = arguments.unit_m;
  if (arguments.up == "y") request.reading.up = simulate::UpAxis::kY;
  if (arguments.up == "z") request.reading.up = simulate::UpAxis::kZ;
  return request;
}

void PrintFlight(const simulate::FlySummary& flight, const FlightArguments& arguments,
                 const CommonOptions& common) {
  const std::string next = "stucco run " + ShellWord(arguments.survey);
  if (common.json) {
    const Json json = {{"survey", arguments.survey},
                       {"photos", flight.photos},
                       {"lost", flight.lost},
                       {"held_out", flight.held_out},
                       {"rendered", flight.rendered},
                       {"megapixels", flight.megapixels},
                       {"render_s", flight.render_s},
                       {"cpu_s", flight.cpu_s},
                       {"notes", flight.notes},
                       {"truth", (fs::path(arguments.survey) / simulate::kFlightFile).string()},
                       {"next", next}};
    PrintJson(json);
    return;
  }
  for (const std::string& note : flight.notes) std::cerr << "note: " << note << "\n";
  if (common.quiet) return;
  std::string beside;
  if (flight.lost > 0) beside += fmt::format(", {} lost", flight.lost);
  if (flight.held_out > 0) beside += fmt::format(", {} held out", flight.held_out);
  std::string speed;
  if (flight.cpu_s > 0 && flight.rendered > 0) {
    speed = fmt::format(", {:.2f} a CPU second", flight.megapixels / flight.cpu_s);
  }
  std::cout << fmt::format("{} photos{}; {} rendered, {:.1f} megapixels in {}{}\n", flight.photos,
                           beside, flight.rendered, flight.megapixels,
                           DurationText(flight.render_s), speed)
            << fmt::format("Truth: {}\nNext: {}\n",
                           (fs::path(arguments.survey) / simulate::kFlightFile).string(), next);
}

}  // namespace

void AddFlightOptions(CLI::App& verb, FlightArguments& arguments) {
  simulate::FlightOptions defaults;
  OptionTable table("simulate");
  simulate::Describe(table, defaults);
  for (const Option& option : table.options()) {
    if (option.name == "seed") continue;
    const bool is_flag = std::holds_alternative<bool*>(option.value);
    const std::string names = OptionNames(option.name, is_flag);
    const auto take = [&arguments, name = option.name](const std::string& value) {
      arguments.set.push_back(fmt::format("{}={}", name, value));
    };
    if (is_flag) {
      verb.add_flag_function(
              names, [take](int64_t count) { take(count > 0 ? "true" : "false"); },
              fmt::format("{} (default {})", option.help, ValueAsToml(option)))
          ->group(kGroup);
      continue;
    }
    verb.add_option_function<std::string>(names, take,
                                          fmt::format("{} ({}; default {})", option.help,
                                                      AllowedValues(option), ValueAsToml(option)))
        ->type_name("VALUE")
        ->group(kGroup);
  }
  verb.add_option("--up", arguments.up, "Which axis of a model points up (default: its format's)")
      ->check(CLI::IsMember({"format", "y", "z"}))
      ->type_name("AXIS")
      ->group(kGroup);
  verb.add_option("--unit", arguments.unit_m, "Metres in one unit of a model (default 1)")
      ->type_name("METRES")
      ->group(kGroup);
}

int SimulateFlight(const FlightArguments& arguments, const Program& program) {
  const simulate::FlightOptions options = ReadOptions(arguments.set);
  const simulate::FlyRequest request = RequestOf(arguments, program.common.threads);
  const Platform platform = CatchInterrupts();
  Console console = Console::ForStderr(program.common.verbosity());
  std::optional<SimulatedSurvey> survey;
  // All that can be wrong with scene and plan shows before the survey is touched.
  const auto progress = [&](size_t done, size_t total) {
    if (done == 0) {
      survey.emplace(request.survey, program.table, program.command_line, console, platform);
      survey->progress().Begin("taking photos", total);
    } else {
      survey->progress().Advance();
    }
    if (platform.interrupted()) {
      throw Error(ErrorKind::kInterrupted, "interrupted",
                  "the same command goes on from here: " + program.command_line);
    }
  };
  const simulate::FlySummary summary = simulate::Fly(request, options, progress);
  survey.reset();  // ends the progress bar
  PrintFlight(summary, arguments, program.common);
  return 0;
}

}  // namespace stucco
