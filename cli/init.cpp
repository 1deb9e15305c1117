// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/verbs/init.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <iostream>

#include "cli/internal/json_output.h"
#include "cli/program.h"
#include "pipeline/engine/engine.h"

namespace stucco {
namespace {

int Init(const CommonOptions& common, const std::string& photos, const StageTable& table) {
  const PhotoFolder found = InitSurvey(common.survey, photos, table);
  constexpr size_t kFewest = 2;
  const std::string next = found.photos < kFewest
                               ? fmt::format("put photos into {}, then: stucco check {}",
                                             ShellWord(photos), ShellWord(common.survey))
                               : "stucco run " + ShellWord(common.survey);
  for (const PhotoProblem& problem : found.problems) {
    std::cerr << "warning: " << problem.why << "\n";
  }
  if (found.photos < kFewest) {
    std::cerr << fmt::format("warning: {} has {} usable photos; a run needs at least two\n", photos,
                             found.photos);
  }
  if (common.json) {
    const Json json = {{"survey", common.survey},
                       {"photos", found.photos},
                       {"megapixels", found.megapixels},
                       {"problems", found.problems.size()},
                       {"next", next}};
    PrintJson(json);
  } else if (!common.quiet) {
    std::cout << fmt::format(
        "Created {}: {} photos, {:.0f} megapixels. Settings are in survey.toml.\n"
        "Next: {}\n",
        common.survey, found.photos, found.megapixels, next);
  }
  return 0;
}

}  // namespace

void AddInit(CLI::App& app, Program& program) {
  CLI::App& verb =
      AddVerb(app, {"init", "Create a survey folder for a folder of photos",
                    "stucco init castle --photos ~/photos/castle\n"
                    "stucco init castle --photos /media/card/DCIM && stucco run castle",
                    kEverydayGroup});
  verb.add_option("survey", program.common.survey, "Folder to create")
      ->type_name("FOLDER")
      ->required();
  auto photos = std::make_shared<std::string>();
  verb.add_option("--photos", *photos, "Folder with the photos; it is never written to")
      ->type_name("FOLDER")
      ->required();
  verb.callback([&program, photos] {
    program.action = [&program, photos] { return Init(program.common, *photos, program.table); };
  });
}

}  // namespace stucco
