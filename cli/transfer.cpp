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
  verb.callback([&program, model] {
    program.action = [&program, model] {
      return IsCloud(*model) ? ImportPly(program, *model) : ImportPoses(program, *model);
    };
  });
}

void AddExport(CLI::App& app, Program& program) {
  CLI::App& verb = AddVerb(app, {"export", "Write a result in another program's format",
                                 "stucco export castle --format glb -o castle.glb\n"
                                 "stucco export castle --format colmap-txt -o colmap\n"
                                 "stucco export castle --format blocksexchange -o castle.xml",
                                 kTransferGroup});
  AddSurveyArgument(verb, program);
  auto format = std::make_shared<std::string>();
  auto out = std::make_shared<std::string>();
  auto overwrite = std::make_shared<bool>(false);
  verb.add_option("-f,--format", *format, FormatHelp())->type_name("FORMAT")->required();
  verb.add_option("-o,--out", *out, "File or folder to write")->type_name("PATH")->required();
  verb.add_flag("--overwrite", *overwrite, "Replace what is there");
  verb.callback([&program, format, out, overwrite] {
    program.action = [&program, format, out, overwrite] {
      ExportSurvey(program.common.survey, *format, *out, *overwrite, program.table);
      if (program.common.json) {
        const Json json = {{"format", *format}, {"out", *out}};
        PrintJson(json);
      } else if (!program.common.quiet) {
        std::cout << "Wrote " << *out << "\n";
      }
      return 0;
    };
  });
}

}  // namespace stucco
