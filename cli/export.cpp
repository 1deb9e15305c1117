// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/verbs/export.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>

#include "cli/internal/json_output.h"
#include "cli/program.h"
#include "pipeline/engine/engine.h"
#include "survey/error.h"

namespace stucco {
namespace {

int Export(const Program& program, ExportRequest request) {
  const CommonOptions& common = program.common;
  request.threads = common.threads;
  request.memory_limit_gb = common.memory_limit_gb;
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

void AddExport(CLI::App& app, Program& program) {
  CLI::App& verb = AddVerb(app, {"export", "Write a result in another program's format",
                                 "stucco export castle --format glb -o castle.glb\n"
                                 "stucco export castle --format colmap-txt -o colmap\n"
                                 "stucco export castle --format blocksexchange -o castle.xml\n"
                                 "stucco export castle --format 3dtiles --epoch 2026-may -o may\n"
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
  verb.add_option("--epoch", request->epoch,
                  "As this epoch shows it, alone, for textured models; default: as the survey "
                  "does, in glb and cityjson with all epochs to switch to")
      ->type_name("NAME");
  verb.callback([&program, request] {
    program.action = [&program, request] { return Export(program, *request); };
  });
}

}  // namespace stucco
