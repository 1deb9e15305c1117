// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/verbs/import.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <Eigen/Core>
#include <filesystem>
#include <iostream>
#include <sstream>

#include "cli/internal/json_output.h"
#include "cli/program.h"
#include "pipeline/engine/engine.h"
#include "pipeline/verbs/import_scan.h"
#include "survey/error.h"

namespace stucco {
namespace {

int ImportPly(const Program& program, const std::string& cloud) {
  const CommonOptions& common = program.common;
  const CloudImportReport report = ImportCloud(common.survey, cloud, program.table, RealPlatform());
  const std::string next = "stucco run " + ShellWord(common.survey);
  if (common.json) {
    const Json json = {{"points", report.points},
                       {"seen_share", report.seen_share},
                       {"notes", report.notes},
                       {"next", next}};
    PrintJson(json);
  } else if (!common.quiet) {
    std::cout << fmt::format("Imported {} points as dense; the photos see {:.0f} % of them.\n",
                             report.points, 100 * report.seen_share);
    for (const std::string& note : report.notes) {
      std::cout << "  " << note << "\n";
    }
    std::cout << "Next: " << next << "\n";
  }
  return 0;
}

int ImportPoses(const Program& program, const std::string& model) {
  const CommonOptions& common = program.common;
  Console console = Console::ForStderr(common.verbosity());
  const ImportReport report =
      ImportModel(common.survey, model, program.table, console, RealPlatform());
  const std::string next = "stucco run " + ShellWord(common.survey);
  if (common.json) {
    const Json json = {{"format", report.format},
                       {"frame", report.frame},
                       {"photos", report.photos},
                       {"points", report.points},
                       {"cameras", report.cameras},
                       {"notes", report.notes},
                       {"next", next}};
    PrintJson(json);
  } else if (!common.quiet) {
    std::cout << fmt::format("Imported {} photos, {} points, {} cameras of {} as calib.\n",
                             report.photos, report.points, report.cameras, report.format);
    for (const std::string& note : report.notes) {
      std::cout << "  " << note << "\n";
    }
    std::cout << "Next: " << next << "\n";
  }
  return 0;
}

int ImportTown(const Program& program, const ScanRequest& request) {
  const CommonOptions& common = program.common;
  if (!IsCloud(request.cloud)) {
    throw Error(
        ErrorKind::kUsage,
        fmt::format("{}: --map goes with a PLY cloud, and this is none", request.cloud.string()),
        "leave out --map to import camera poses");
  }
  const ScanImportReport report = ImportScan(common.survey, request, program.table, RealPlatform());
  const std::string next = fmt::format("stucco run {} --until proxy", ShellWord(common.survey));
  if (common.json) {
    const Json json = {{"points", report.points},
                       {"buildings", report.buildings},
                       {"reached", report.reached},
                       {"notes", report.notes},
                       {"next", next}};
    PrintJson(json);
  } else if (!common.quiet) {
    std::cout << fmt::format("Imported {} points as dense, and {} footprints as the plan.\n",
                             report.points, report.buildings);
    for (const std::string& note : report.notes) std::cout << "  " << note << "\n";
    std::cout << "Next: " << next << "\n";
  }
  return 0;
}

int ImportSurfaceModel(const Program& program, const SurfaceImportRequest& request) {
  const CommonOptions& common = program.common;
  const SurfaceImportReport report =
      ImportSurfaces(common.survey, request, program.table, RealPlatform());
  const std::string next = "stucco run " + ShellWord(common.survey);
  if (common.json) {
    const Json json = {{"format", report.format}, {"buildings", report.buildings},
                       {"closed", report.closed}, {"facets", report.facets},
                       {"notes", report.notes},   {"next", next}};
    PrintJson(json);
  } else if (!common.quiet) {
    std::cout << fmt::format(
        "Imported {} facets of {} buildings, {} of them closed, from {} as proxy.\n", report.facets,
        report.buildings, report.closed, report.format);
    for (const std::string& note : report.notes) std::cout << "  " << note << "\n";
    std::cout << "Next: " << next << "\n";
  }
  return 0;
}

// What --crs, --offset, --up and --fit say of a model of surfaces.
struct SurfaceWords {
  std::string offset;
  std::string up = "format";
  bool fit = false;
  CLI::Option* fit_option = nullptr;

  bool AnySaid() const { return !offset.empty() || up != "format" || fit_option->count() > 0; }
};

Eigen::Vector3d OffsetOf(const std::string& text) {
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();
  if (text.empty()) return offset;
  std::istringstream words(text);
  char comma = ',';
  char more = 0;
  for (int i = 0; i < 3; ++i) {
    if (i > 0 && (!(words >> comma) || comma != ',')) break;
    if (!(words >> offset[i])) break;
  }
  if (!words || (words >> more) || !offset.allFinite()) {
    throw Error(ErrorKind::kUsage, fmt::format("--offset {}: is no three numbers", text),
                "give what was taken off the coordinates, as --offset 500000,5540000,200");
  }
  return offset;
}

SurfaceImportRequest RequestOf(const std::string& model, const std::string& crs,
                               const SurfaceWords& words) {
  SurfaceImportRequest request;
  request.file = model;
  request.crs = crs;
  request.offset = OffsetOf(words.offset);
  request.up = words.up == "y" ? UpAxis::kY : words.up == "z" ? UpAxis::kZ : UpAxis::kOfFormat;
  if (words.fit_option->count() > 0) request.fits = words.fit;
  return request;
}

int Import(const Program& program, const std::string& model, ScanRequest scan,
           const SurfaceWords& words) {
  const bool is_town = !scan.map.empty();
  if (words.AnySaid() && (is_town || !IsSurfaceModel(model))) {
    throw Error(ErrorKind::kUsage, "--offset, --up and --fit go with a model of surfaces",
                "leave them out: poses and clouds say themselves where they lie");
  }
  if (is_town) {
    scan.cloud = model;
    return ImportTown(program, scan);
  }
  if (IsSurfaceModel(model)) return ImportSurfaceModel(program, RequestOf(model, scan.crs, words));
  if (!scan.crs.empty()) {
    throw Error(ErrorKind::kUsage, "--crs goes with --map, or with a model of surfaces",
                "leave it out: poses and clouds are in the frame of the survey");
  }
  return IsCloud(model) ? ImportPly(program, model) : ImportPoses(program, model);
}

void AddSurfaceOptions(CLI::App& verb, SurfaceWords& words) {
  const std::string group = "A model of surfaces";
  verb.add_option("--offset", words.offset,
                  "What was taken off its coordinates, as 500000,5540000,200; default: nothing")
      ->type_name("X,Y,Z")
      ->group(group);
  verb.add_option("--up", words.up, "Which of its axes points up; default: its format's")
      ->type_name("AXIS")
      ->check(CLI::IsMember({"format", "y", "z"}))
      ->group(group);
  words.fit_option =
      verb.add_flag("--fit,!--no-fit", words.fit,
                    "Move it onto the survey's points (by metres) or leave it where it is; "
                    "default: move it where a coordinate system says where it lies")
          ->group(group);
}

}  // namespace

void AddImport(CLI::App& app, Program& program) {
  CLI::App& verb = AddVerb(
      app, {"import",
            "Take camera poses of another program in the place of calib, a PLY cloud in that "
            "of dense, or a model of buildings in that of proxy",
            "stucco import castle ~/colmap/sparse/0 && stucco run castle\n"
            "stucco import castle block.xml     (BlocksExchange)\n"
            "stucco import castle scan.ply      (in the frame of the poses)\n"
            "stucco import castle lod2.city.json   (OBJ, GLB, CityJSON: to be textured)\n"
            "stucco import town laser.ply --map town.gpkg --crs EPSG:25832\n"
            "stucco calib castle --force        (back to our own poses)",
            kTransferGroup});
  AddSurveyArgument(verb, program);
  auto model = std::make_shared<std::string>();
  verb.add_option(
          "model", *model,
          "COLMAP folder, bundle.out (Bundler), BlocksExchange XML, reconstruction.json "
          "(OpenSfM), folder of XMP files (RealityCapture), PLY cloud, or model of surfaces (OBJ, "
          "GLB, glTF, CityJSON); recognised by contents")
      ->type_name("PATH")
      ->required();
  const std::string group = "A scan from above, without photos";
  auto scan = std::make_shared<ScanRequest>();
  CLI::Option* map =
      verb.add_option("--map", scan->map,
                      "Building footprints (any format that plan reads): the PLY cloud and the map "
                      "become a survey without photos")
          ->type_name("FILE")
          ->group(group);
  verb.add_option("--crs", scan->crs,
                  "Coordinate system of the cloud, default: --map-crs; or of a model of surfaces, "
                  "default: what its file says, else the survey's own frame")
      ->type_name("EPSG:n");
  verb.add_option("--map-crs", scan->map_crs,
                  "Coordinate system of a map that names none; default: --crs")
      ->type_name("EPSG:n")
      ->needs(map)
      ->group(group);
  auto words = std::make_shared<SurfaceWords>();
  AddSurfaceOptions(verb, *words);
  verb.callback([&program, model, scan, words] {
    program.action = [&program, model, scan, words] {
      return Import(program, *model, *scan, *words);
    };
  });
}

}  // namespace stucco
