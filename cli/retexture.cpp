// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/verbs/retexture.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <set>

#include "cli/internal/json_output.h"
#include "cli/interrupt.h"
#include "cli/program.h"

namespace stucco {
namespace {

// As people read it: what changed in the world, and what was done about it.
void PrintFacet(const EpochFacet& facet) {
  const bool changed = facet.repainted + facet.other > 0;
  if (facet.choice == FacetChoice::kKept && !changed) return;
  std::cout << fmt::format("  {}: {}: {}\n", facet.id, Name(facet.choice), facet.why);
  if (facet.repainted > 0) {
    std::cout << fmt::format("    {:.0f} % of it have another colour\n", 100 * facet.repainted);
  }
  if (facet.other > 0) {
    std::cout << fmt::format("    {:.0f} % of it show something else\n", 100 * facet.other);
  }
  for (const EpochPlace& place : facet.places) {
    std::cout << fmt::format("    another {} from {:.1f} to {:.1f} along it, {:.1f} to {:.1f} up\n",
                             place.what, place.along_m[0], place.along_m[1], place.up_m[0],
                             place.up_m[1]);
  }
}

void PrintReport(const RetextureReport& report, const CommonOptions& common) {
  const Epoch& epoch = report.epoch;
  const auto placed = std::ranges::count(epoch.photos, true, &EpochPhoto::is_placed);
  const auto kept = std::ranges::count(epoch.facets, FacetChoice::kKept, &EpochFacet::choice);
  if (common.json) {
    Json facets = Json::array();
    for (const EpochFacet& facet : epoch.facets) {
      facets.push_back({{"id", facet.id},
                        {"choice", Name(facet.choice)},
                        {"why", facet.why},
                        {"repainted", facet.repainted},
                        {"other", facet.other}});
    }
    const Json json = {{"epoch", epoch.name},
                       {"folder", report.folder.string()},
                       {"photos", epoch.photos.size()},
                       {"placed", placed},
                       {"moved", report.moved ? Json(report.moved->string()) : Json()},
                       {"facets", facets}};
    PrintJson(json);
    return;
  }
  if (common.quiet) return;
  std::cout << fmt::format("{} of {} photos placed; {} of {} facets keep their pictures.\n", placed,
                           epoch.photos.size(), kept, epoch.facets.size());
  for (const EpochFacet& facet : epoch.facets) PrintFacet(facet);
  if (report.moved) {
    std::cout << fmt::format("What was there is now {}.\n", report.moved->string());
  }
  std::cout << fmt::format("Epoch: {0}\nReport: {0}/report.html\n", report.folder.string());
}

int RetextureAndPrint(const Program& program, RetextureRequest request, const Platform& platform) {
  request.threads = program.common.threads;
  request.memory_limit_gb = program.common.memory_limit_gb;
  request.command = program.command_line;
  Console console = Console::ForStderr(program.common.verbosity());
  PrintReport(RetextureSurvey(program.common.survey, request, program.table, console, platform),
              program.common);
  return 0;
}

}  // namespace

int RunAndRetexture(const Program& program, RunOptions options, const std::string& epoch) {
  const RetextureRequest request = SameAgain(program.common.survey, epoch);
  const Platform platform = CatchInterrupts();
  std::error_code error;
  const bool can_paint = std::filesystem::is_directory(request.photos, error);
  // The epoch's photos are enough: without the survey's its textures are taken as they are.
  if (can_paint && HasPhotos(program.common.survey, program.table)) {
    if (const int failed = RunBefore(program, std::move(options), platform)) return failed;
  } else if (can_paint && !program.common.quiet) {
    std::cerr << "warning: the survey's photos are gone: its textures are taken as they are\n";
  }
  return RetextureAndPrint(program, request, platform);
}

void AddRetexture(CLI::App& app, Program& program) {
  CLI::App& verb =
      AddVerb(app, {"retexture",
                    "Paint a finished survey from photos of another day, as an epoch beside it",
                    "stucco retexture castle --photos ~/Pictures/2026-spring\n"
                    "stucco retexture castle --photos phone --epoch after-rain --replace always",
                    kEverydayGroup});
  AddSurveyArgument(verb, program);
  auto request = std::make_shared<RetextureRequest>();
  auto mode = std::make_shared<std::string>("auto");
  verb.add_option("--photos", request->photos,
                  "Folder of the new photos, of any camera; they are never written to")
      ->type_name("FOLDER")
      ->required();
  verb.add_option("--epoch", request->epoch,
                  "What the epoch is called; its folder is epochs/NAME in the survey (default: as "
                  "the photo folder)")
      ->type_name("NAME");
  verb.add_option("--replace", *mode,
                  "auto: pictures of facets that changed, and gaps of those that did not; always: "
                  "wherever new photos show a facet; never: fill gaps only")
      ->type_name("WHEN")
      ->check(CLI::IsMember(std::set<std::string>{"auto", "always", "never"}))
      ->capture_default_str();
  verb.callback([&program, request, mode] {
    program.action = [&program, request, mode] {
      request->replace = ReplaceModeFromName(*mode).value_or(ReplaceMode::kAuto);
      return RetextureAndPrint(program, *request, CatchInterrupts());
    };
  });
}

}  // namespace stucco
