// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/verbs/plan.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <iostream>

#include "cli/internal/json_output.h"
#include "cli/interrupt.h"
#include "cli/program.h"
#include "pipeline/engine/engine.h"
#include "survey/survey_folder.h"

namespace stucco {
namespace {

void PrintSummary(const plan::PlanSummary& summary, const CommonOptions& common) {
  const std::string next = "stucco run " + ShellWord(common.survey);
  const auto in_plan = [&](const char* name) {
    return (std::filesystem::path(common.survey) / kPlanFolder / name).string();
  };
  if (common.json) {
    const Json json = {{"survey", common.survey},
                       {"method", summary.method},
                       {"photos", summary.photos},
                       {"hovers", summary.hovers},
                       {"flights", summary.flights},
                       {"length_m", summary.length_m},
                       {"time_min", summary.time_min},
                       {"battery_percent", summary.battery_percent},
                       {"repairs", summary.repairs},
                       {"warnings", summary.warnings},
                       {"notes", summary.notes},
                       {"stats", in_plan("stats.json")},
                       {"preview", in_plan("preview.svg")},
                       {"checklist", in_plan("checklist.html")},
                       {"next", next}};
    PrintJson(json);
    return;
  }
  for (const std::string& repair : summary.repairs) std::cerr << "map: " << repair << "\n";
  if (!common.quiet) std::cout << summary.table << std::flush;
  for (const std::string& warning : summary.warnings) std::cerr << "warning: " << warning << "\n";
  if (common.quiet) return;
  for (const std::string& note : summary.notes) std::cout << "note: " << note << "\n";
  std::cout << fmt::format(
      "Preview: {}\nTo take along: {}\nFly it, put the photos into {}, then: {}\n",
      in_plan("preview.svg"), in_plan("checklist.html"),
      (std::filesystem::path(common.survey) / "photos").string(), next);
}

// --gsd and --gsd-m for gsd_m, --wind and --wind-m-per-s for wind_m_per_s; the values end up in
// `set`.
void AddPlanOptions(CLI::App& verb, std::vector<std::string>& set) {
  ForPlanOptions([&](const Option& option) {
    std::string dashed = option.name;
    std::replace(dashed.begin(), dashed.end(), '_', '-');
    std::string names = "--" + dashed;
    if (std::holds_alternative<bool*>(option.value)) {
      verb.add_flag_function(
              fmt::format("{},!--no-{}", names, dashed),
              [&set, name = option.name](int64_t count) {
                set.push_back(fmt::format("{}={}", name, count > 0));
              },
              fmt::format("{} (default {})", option.help, ValueAsToml(option)))
          ->group("What is planned");
      return;
    }
    for (const std::string_view unit : {"-m", "-m-per-s"}) {
      if (!dashed.ends_with(unit)) continue;
      names = fmt::format("--{},{}", dashed.substr(0, dashed.size() - unit.size()), names);
    }
    const std::string allowed = AllowedValues(option);
    verb.add_option_function<std::string>(
            names,
            [&set, name = option.name](const std::string& value) {
              set.push_back(fmt::format("{}={}", name, value));
            },
            fmt::format("{} ({}default {})", option.help, allowed.empty() ? "" : allowed + "; ",
                        ValueAsToml(option)))
        ->type_name("VALUE")
        ->group("What is planned");
  });
}

}  // namespace

void AddPlan(CLI::App& app, Program& program) {
  CLI::App& verb =
      AddVerb(app, {"plan", "Plan the flight of a survey from a map of building footprints",
                    "stucco plan town.geojson -o survey --altitude 45\n"
                    "stucco plan delft.city.json -o survey --camera phantom-4-rtk --gsd 0.015\n"
                    "stucco plan town.gpkg -o survey --terrain dem.tif --no-fly zones.geojson",
                    kEverydayGroup});
  auto request = std::make_shared<PlanRequest>();
  verb.add_option("map", request->map,
                  "Building footprints: GeoJSON, GeoPackage, Shapefile, OSM, CityJSON")
      ->type_name("FILE")
      ->required();
  verb.add_option("-o,--out", program.common.survey,
                  "Survey folder; created when it is not there, its plan is replaced when it is")
      ->type_name("FOLDER")
      ->required();
  verb.add_option("--area", request->area,
                  "Polygons that hold the buildings to capture; others are only in the way")
      ->type_name("FILE");
  verb.add_option("--no-fly", request->no_fly, "Polygons that must not be flown over")
      ->type_name("FILE");
  verb.add_option("--obstacles", request->obstacles,
                  "Trees, wires, cranes: polygons, lines or points with a height, kept clear of")
      ->type_name("FILE");
  verb.add_option("--terrain", request->terrain, "Height of the ground (GeoTIFF)")
      ->type_name("FILE");
  verb.add_option("--home", request->home, "Where flights begin and end")
      ->type_name("LATITUDE,LONGITUDE");
  AddPlanOptions(verb, request->set);
  verb.callback([&program, request] {
    program.action = [&program, request] {
      const Platform platform = CatchInterrupts();
      request->threads = program.common.threads;
      Console console = Console::ForStderr(program.common.verbosity());
      PrintSummary(PlanSurvey(program.common.survey, *request, program.table, console, platform),
                   program.common);
      return 0;
    };
  });
}

}  // namespace stucco
