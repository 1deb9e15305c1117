// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>

#include "cli/internal/json_output.h"
#include "cli/program.h"
#include "pipeline/engine/engine.h"
#include "pipeline/verbs/export.h"
#include "pipeline/verbs/import.h"
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

int Export(const Program& program, const ExportRequest& request) {
  const CommonOptions& common = program.common;
  const ExportReport report = ExportSurvey(common.survey, request, program.table);
  const std::string folder = report.pictures_folder.string();
  if (common.json) {
    Json json = {{"format", request.format}, {"out", request.out.string()}};
    if (!folder.empty()) json["pictures_folder"] = folder;
    if (!report.notes.empty()) json["notes"] = report.notes;
    PrintJson(json);
  } else if (!common.quiet) {
    std::cout << "Wrote " << request.out.string() << "\n";
    if (!folder.empty()) {
      std::cout << fmt::format("and {}, with the {} pictures that it names: keep them together\n",
                               folder, report.pictures);
    }
    for (const std::string& note : report.notes) std::cout << "  " << note << "\n";
  }
  return 0;
}

std::string FormatHelp() {
  std::string text = "One of";
  for (const ExportFormat& format : ExportFormats()) {
    text += fmt::format("\n{} ({})", format.name, format.help);
  }
  return text;
}

}  // namespace

void AddImport(CLI::App& app, Program& program) {
  CLI::App& verb =
      AddVerb(app, {"import",
                    "Take camera poses of another program in the place of calib, or a PLY cloud in "
                    "that of dense",
                    "stucco import castle ~/colmap/sparse/0 && stucco run castle\n"
                    "stucco import castle block.xml     (BlocksExchange)\n"
                    "stucco import castle scan.ply      (in the frame of the poses)\n"
                    "stucco import town laser.ply --map town.gpkg --crs EPSG:25832\n"
                    "stucco calib castle --force        (back to our own poses)",
                    kTransferGroup});
  AddSurveyArgument(verb, program);
  auto model = std::make_shared<std::string>();
  verb.add_option("model", *model,
                  "COLMAP folder, bundle.out (Bundler), BlocksExchange XML, reconstruction.json "
                  "(OpenSfM), folder of XMP files (RealityCapture), or PLY cloud; recognised by "
                  "contents")
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
  verb.add_option("--crs", scan->crs, "Coordinate system of the cloud; default: --map-crs")
      ->type_name("EPSG:n")
      ->needs(map)
      ->group(group);
  verb.add_option("--map-crs", scan->map_crs,
                  "Coordinate system of a map that names none; default: --crs")
      ->type_name("EPSG:n")
      ->needs(map)
      ->group(group);
  verb.callback([&program, model, scan] {
    program.action = [&program, model, scan] {
      if (!scan->map.empty()) {
        scan->cloud = *model;
        return ImportTown(program, *scan);
      }
      return IsCloud(*model) ? ImportPly(program, *model) : ImportPoses(program, *model);
    };
  });
}

void AddExport(CLI::App& app, Program& program) {
  CLI::App& verb = AddVerb(app, {"export", "Write a result in another program's format",
                                 "stucco export castle --format glb -o castle.glb\n"
                                 "stucco export castle --format colmap-txt -o colmap\n"
                                 "stucco export castle --format blocksexchange -o castle.xml\n"
                                 "stucco export town --format cityjson --crs EPSG:25832 -o t.json",
                                 kTransferGroup});
  AddSurveyArgument(verb, program);
  auto request = std::make_shared<ExportRequest>();
  verb.add_option("-f,--format", request->format, FormatHelp())->type_name("FORMAT")->required();
  verb.add_option("-o,--out", request->out, "File or folder to write")
      ->type_name("PATH")
      ->required();
  verb.add_flag("--overwrite", request->overwrite, "Replace what is there");
  verb.add_option("--crs", request->crs,
                  "Coordinate system of the corners, for cityjson; default: the survey's own frame")
      ->type_name("EPSG:n");
  verb.callback([&program, request] {
    program.action = [&program, request] { return Export(program, *request); };
  });
}

}  // namespace stucco
