// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/verbs/init.h"

#include <fmt/format.h>

#include "pipeline/engine/exit_code.h"
#include "pipeline/engine/layout.h"
#include "pipeline/engine/resources.h"
#include "pipeline/engine/settings.h"
#include "survey/error.h"
#include "survey/files.h"
#include "survey/survey_folder.h"
#include "survey/utf8.h"

namespace stucco {
namespace {

namespace fs = std::filesystem;

// A run replaces what is named like a stage.
void RequireNoStageNames(const fs::path& survey, const StageTable& table) {
  for (const Stage& stage : table) {
    std::error_code error;
    if (fs::exists(fs::symlink_status(survey / stage.name, error))) {
      throw Error(ErrorKind::kBadInput,
                  fmt::format("{}: already has an entry {}, where a run would put its results",
                              survey.string(), stage.name),
                  "choose a new folder for the survey");
    }
  }
}

}  // namespace

PhotoFolder InitSurvey(const fs::path& survey, const fs::path& photos, const StageTable& table) {
  std::error_code error;
  const fs::path settings = survey / kSettingsFile;
  if (fs::exists(settings, error)) {
    throw Error(
        ErrorKind::kBadInput, fmt::format("{}: there already is a survey", survey.string()),
        fmt::format("change its settings in {}, or choose another folder", settings.string()));
  }
  if (fs::exists(survey, error) && !fs::is_directory(survey, error)) {
    throw Error(ErrorKind::kBadInput, fmt::format("{}: is a file, not a folder", survey.string()),
                "choose another name for the survey");
  }
  PhotoFolder found = InspectPhotos(photos, AvailableCores());
  RequireApart(survey, photos, table);
  RequireNoStageNames(survey, table);
  const fs::path real_survey = RealPath(survey), real_photos = RealPath(photos);
  const std::string written = IsInside(real_photos, real_survey)
                                  ? real_photos.lexically_relative(real_survey).generic_string()
                                  : real_photos.string();
  if (!IsPrintableUtf8(written)) {
    throw Error(ErrorKind::kBadInput,
                fmt::format("{}: its path is not valid UTF-8 or has control characters, so that "
                            "{} cannot name it",
                            photos.string(), kSettingsFile),
                "rename the folder, or give a link to it that has a plain name");
  }
  fs::create_directories(survey, error);
  if (error) {
    throw Error(ErrorKind::kBadInput,
                fmt::format("{}: cannot be created ({})", survey.string(), error.message()),
                "choose a folder that you may write to");
  }
  WriteFileAtomically(settings, SettingsTemplate(table, written));
  return found;
}

void InitWaitingSurvey(const fs::path& survey, const StageTable& table) {
  std::error_code error;
  if (fs::exists(survey, error) && !fs::is_directory(survey, error)) {
    throw Error(ErrorKind::kBadInput, fmt::format("{}: is a file, not a folder", survey.string()),
                "choose another name for the survey");
  }
  if (fs::exists(survey / kSettingsFile, error)) return;
  fs::create_directories(survey / kWaitingPhotos, error);
  if (error) {
    throw WriteError(survey / kWaitingPhotos, "cannot be created", error.value());
  }
  RequireApart(survey, survey / kWaitingPhotos, table);
  WriteFileAtomically(survey / kSettingsFile, SettingsTemplate(table, kWaitingPhotos));
}

}  // namespace stucco
