// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
// report_page_maker FOLDER [full|units|failed|hostile|empty|many]: writes a made survey and its
// report, for the browser test and for looking at the page.
#include <filesystem>
#include <iostream>
#include <string>

#include "report/report.h"
#include "tests/report/made_survey.h"

namespace {

std::vector<stucco::StageStatus> Statuses(bool failed) {
  std::vector<stucco::StageStatus> statuses;
  for (const char* stage : {"ingest", "calib", "dense", "proxy", "texture"}) {
    stucco::StageStatus status;
    status.stage = stage;
    status.state = "done";
    statuses.push_back(status);
  }
  if (failed) {
    statuses[4].state = "failed";
    statuses[4].why = "texture/textures: no space left on device";
    statuses[4].remedy = "free 2.1 GB on the disk of the survey";
  }
  return statuses;
}

void MakeHostile(stucco::MadeSurvey& made) {
  const std::string names[] = {"<script>document.title='owned'</script>.jpg",
                               "\"><img src=x onerror=document.title='owned'>.jpg",
                               "emoji 😀 & ampersand.jpg",
                               "\u202egpj.txt שלום.jpg",
                               std::string(300, 'x') + ".jpg",
                               "'); document.title='owned'; ('"};
  auto& facets = made.textures.facets;
  for (size_t i = 0; i < std::size(names); ++i) {
    facets[0].photos.push_back(names[i]);
    made.calibration.unposed.push_back({names[i], names[i]});
    made.captures.photos[i].path = names[i];
  }
  facets[1].id = made.proxy.buildings[0].facets[1].id = names[1];
  made.captures.cameras[0].label = made.calibration.cameras[0].label = names[0];
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) return 2;
  const std::filesystem::path survey = argv[1];
  const std::string kind = argc > 2 ? argv[2] : "full";
  stucco::MadeSurvey made =
      stucco::MakeSurvey({.buildings = kind == "many" ? 100 : 3, .metric = kind != "units"});
  if (kind == "hostile") MakeHostile(made);
  std::filesystem::create_directories(survey);
  if (kind != "empty") stucco::WriteSurvey(made, survey);
  if (kind == "failed") std::filesystem::remove(survey / "texture/textures.json");
  stucco::StageContext context;
  context.survey = survey;
  context.out = survey / "report";
  context.threads = 2;
  context.progress = &stucco::SilentProgress();
  context.units = &stucco::NoUnits();
  if (kind != "empty") context.statuses = Statuses(kind == "failed");
  std::filesystem::create_directories(context.out);
  stucco::RunReport({}, context);
  std::cout << (context.out / "report.html").string() << "\n";
}
