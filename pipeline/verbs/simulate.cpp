// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/verbs/simulate.h"

#include <fmt/format.h>

#include "pipeline/engine/events.h"
#include "pipeline/engine/layout.h"
#include "pipeline/engine/lock.h"
#include "pipeline/engine/progress.h"
#include "pipeline/engine/settings.h"
#include "pipeline/engine/work_folder.h"
#include "pipeline/verbs/init.h"
#include "survey/error.h"

namespace stucco {
namespace {

namespace fs = std::filesystem;

// The survey itself, once it is one whose photos lie where InitWaitingSurvey puts them.
const fs::path& Prepared(const fs::path& survey, const StageTable& table) {
  InitWaitingSurvey(survey, table);
  const fs::path photos = LoadSettings(survey, table, {}).photos;
  if (RealPath(photos) != RealPath(survey / kWaitingPhotos)) {
    throw Error(ErrorKind::kBadInput,
                fmt::format("{}: its photos are in {}", survey.string(), photos.string()),
                "simulate into a new survey");
  }
  return survey;
}

}  // namespace

struct SimulatedSurvey::Work {
  Work(const fs::path& survey, const StageTable& table, const std::string& command,
       Console& console, const Platform& platform)
      : lock(Prepared(survey, table), command, platform),
        events(WorkFolder(survey).Events()),
        progress("simulate", console, events, platform.interrupted) {}

  SurveyLock lock;
  EventLog events;
  StageProgress progress;
};

SimulatedSurvey::SimulatedSurvey(const fs::path& survey, const StageTable& table,
                                 const std::string& command, Console& console,
                                 const Platform& platform)
    : work_(std::make_unique<Work>(survey, table, command, console, platform)) {}

SimulatedSurvey::~SimulatedSurvey() = default;

Progress& SimulatedSurvey::progress() {
  return work_->progress;
}

}  // namespace stucco
