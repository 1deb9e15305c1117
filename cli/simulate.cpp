// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>

#include "cli/internal/json_output.h"
#include "cli/program.h"
#include "pipeline/shell.h"
#include "simulate/city/make_city.h"
#include "simulate/scene/scene_folder.h"

namespace stucco {
namespace {

namespace fs = std::filesystem;

// What follows `stucco simulate`: the word city, or a scene and a plan.
struct SimulateArguments {
  std::string scene;
  std::string plan;
  std::string out;
  simulate::CityOptions city;
};

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
  verb.add_option("--seed", city.seed, "Another number makes another place")
      ->type_name("NUMBER")
      ->capture_default_str()
      ->group(kGroup);
  verb.add_option("--texel", city.metres_per_texel, "Size of a texel of walls and roofs, in metres")
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
  CLI::App& verb = AddVerb(app, {"simulate", "Make a textured city with its truth",
                                 "stucco simulate city -o hamlet --seed 7\n"
                                 "stucco simulate city -o quarter --style block",
                                 kEverydayGroup});
  auto arguments = std::make_shared<SimulateArguments>();
  verb.add_option("scene", arguments->scene, "The word city")->type_name("city")->required();
  verb.add_option("-o,--out", arguments->out, "Folder to make; an older scene in it is replaced")
      ->type_name("FOLDER")
      ->required();
  AddCityOptions(verb, arguments->city);
  verb.callback([&program, arguments] {
    program.action = [&program, arguments] {
      if (arguments->scene != "city") {
        throw Error(ErrorKind::kUsage, fmt::format("simulate {}: is not known", arguments->scene),
                    "say stucco simulate city -o FOLDER");
      }
      return SimulateCity(*arguments, program.common);
    };
  });
}

}  // namespace stucco
