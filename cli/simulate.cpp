// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>
#include <memory>

#include "cli/internal/json_output.h"
#include "cli/program.h"
#include "cli/simulate_flight.h"
#include "pipeline/engine/engine.h"
#include "simulate/city/make_city.h"
#include "simulate/scene/scene_folder.h"
#include "survey/error.h"

namespace stucco {
namespace {

namespace fs = std::filesystem;

// What follows `stucco simulate`: the word city, or a scene and a plan.
struct SimulateArguments {
  std::string scene;
  std::string out;
  simulate::CityOptions city;
  FlightArguments flight;
};

std::string ChangesText(const simulate::DayChanges& changes) {
  std::string text;
  const auto add = [&text](const char* what, const std::vector<std::string>& names) {
    if (!names.empty()) text += fmt::format("{}: {}\n", what, fmt::join(names, ", "));
  };
  add("Repainted", changes.repainted);
  add("Gone", changes.gone);
  add("Come", changes.come);
  return text;
}

void PrintCity(const simulate::CitySummary& city, const SimulateArguments& arguments,
               const CommonOptions& common) {
  const fs::path folder = arguments.out;
  const std::string map = (folder / simulate::kSceneMap).string();
  const std::string model = (folder / simulate::kSceneModel).string();
  const fs::path terrain = folder / simulate::kSceneTerrain;
  std::string next = fmt::format("stucco plan {} -o SURVEY", ShellWord(map));
  if (fs::exists(terrain)) next += " --terrain " + ShellWord(terrain.string());
  if (common.json) {
    const Json json = {{"scene", arguments.out},
                       {"style", arguments.city.style},
                       {"seed", arguments.city.seed},
                       {"day", arguments.city.day},
                       {"repainted", city.changes.repainted},
                       {"gone", city.changes.gone},
                       {"come", city.changes.come},
                       {"buildings", city.buildings},
                       {"facades", city.facades},
                       {"wall_area_m2", city.wall_area_m2},
                       {"triangles", city.triangles},
                       {"model", model},
                       {"map", map},
                       {"next", next}};
    PrintJson(json);
    return;
  }
  if (common.quiet) return;
  std::cout << fmt::format("{}: {} buildings, {} facades, {:.0f} m2 of walls, {} triangles\n",
                           arguments.city.style, city.buildings, city.facades, city.wall_area_m2,
                           city.triangles)
            << ChangesText(city.changes)
            << fmt::format("Model: {}\nPlan a flight: {}\n", model, next);
}

int SimulateCity(SimulateArguments& arguments, const CommonOptions& common) {
  arguments.city.threads = common.threads;
  PrintCity(simulate::MakeCity(arguments.city, arguments.out), arguments, common);
  return 0;
}

void AddCityOptions(CLI::App& verb, simulate::CityOptions& city) {
  constexpr char kGroup[] = "The city that is made";
  verb.add_option("--style", city.style, "hamlet, block, asia, campus or terrain")
      ->type_name("STYLE")
      ->capture_default_str()
      ->group(kGroup);
  verb.add_option("--seed", city.seed, "Another number makes another place, or another flight")
      ->type_name("NUMBER")
      ->capture_default_str()
      ->group(kGroup);
  verb.add_option("--day", city.day,
                  "Of a later day than 1 one facade is repainted, one car gone and one come: for "
                  "`stucco retexture`")
      ->type_name("NUMBER")
      ->capture_default_str()
      ->group(kGroup);
  verb.add_flag("--repeat", city.repeat,
                "Every bay of every storey of a wall looks the same, to the texel")
      ->group(kGroup);
  verb.add_option(
          "--texel", city.metres_per_texel,
          "Size of a texel of walls and roofs, in metres; those of the ground are no smaller")
      ->type_name("METRES")
      ->capture_default_str()
      ->group(kGroup);
  verb.add_option("--latitude", city.latitude_deg, "Where the city lies, in degrees")
      ->type_name("DEGREES")
      ->capture_default_str()
      ->group(kGroup);
  verb.add_option("--longitude", city.longitude_deg, "Where the city lies, in degrees")
      ->type_name("DEGREES")
      ->capture_default_str()
      ->group(kGroup);
  verb.add_option("--height", city.height_m, "Of its ground above the ellipsoid, in metres")
      ->type_name("METRES")
      ->capture_default_str()
      ->group(kGroup);
}

}  // namespace

void AddSimulate(CLI::App& app, Program& program) {
  CLI::App& verb =
      AddVerb(app, {"simulate", "Make a textured city with its truth, or fly a plan through one",
                    "stucco simulate city -o hamlet --seed 7\n"
                    "stucco plan hamlet/map.geojson -o survey\n"
                    "stucco simulate hamlet survey -o survey --scale 0.25\n"
                    "stucco simulate quarter.glb survey -o survey --rtk --lost-share 0.05",
                    kEverydayGroup});
  auto arguments = std::make_shared<SimulateArguments>();
  verb.add_option("scene", arguments->scene,
                  "The word city; or the scene to fly through: a folder made so, or a textured "
                  "model (GLB, OBJ)")
      ->type_name("city|SCENE")
      ->required();
  verb.add_option("plan", arguments->flight.plan, "plan.json, or a survey that has one")
      ->type_name("PLAN");
  verb.add_option("-o,--out", arguments->out,
                  "Folder to make: of the city (an older one in it is replaced), or of the survey "
                  "with the photos and their truth")
      ->type_name("FOLDER")
      ->required();
  AddCityOptions(verb, arguments->city);
  AddFlightOptions(verb, arguments->flight);
  verb.callback([&program, arguments] {
    program.action = [&program, arguments] {
      if (arguments->out.empty()) {
        throw Error(ErrorKind::kUsage, "-o: the name of the folder is empty",
                    "say which folder to make");
      }
      FlightArguments& flight = arguments->flight;
      if (arguments->scene == "city" && flight.plan.empty()) {
        return SimulateCity(*arguments, program.common);
      }
      if (flight.plan.empty()) {
        throw Error(ErrorKind::kUsage,
                    fmt::format("simulate {}: no plan to fly by is given", arguments->scene),
                    "say stucco simulate SCENE PLAN -o SURVEY, or stucco simulate city -o FOLDER");
      }
      flight.scene = arguments->scene;
      flight.survey = arguments->out;
      flight.set.push_back(fmt::format("seed={}", arguments->city.seed));
      return SimulateFlight(flight, program);
    };
  });
}

}  // namespace stucco
