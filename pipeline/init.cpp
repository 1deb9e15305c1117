// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/init.h"

#include <fmt/format.h>

#include "pipeline/resources.h"
#include "pipeline/settings.h"
#include "survey/error.h"
#include "survey/files.h"
#include "survey/survey_folder.h"

namespace stucco {
namespace {

namespace fs = std::filesystem;

// True for a folder itself and for all that is below it.
bool IsInside(const fs::path& path, const fs::path& folder) {
  const std::string relative = path.lexically_relative(folder).string();
  return !relative.empty() && relative.substr(0, 2) != "..";
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
  const PhotoFolder found = InspectPhotos(photos, AvailableCores());
  const fs::path real_survey = fs::weakly_canonical(survey);
  const fs::path real_photos = fs::canonical(photos);
  if (IsInside(real_survey, real_photos)) {
    throw Error(
        ErrorKind::kBadInput,
        fmt::format("{}: lies inside the photo folder {}", survey.string(), photos.string()),
        "choose a folder beside the photos; the photo folder is never written to");
  }
  fs::create_directories(survey, error);
  if (error) {
    throw Error(ErrorKind::kBadInput,
                fmt::format("{}: cannot be created ({})", survey.string(), error.message()),
                "choose a folder that you may write to");
  }
  const std::string written = IsInside(real_photos, real_survey)
                                  ? real_photos.lexically_relative(real_survey).generic_string()
                                  : real_photos.string();
  WriteFileAtomically(settings, SettingsTemplate(table, written));
  return found;
}

}  // namespace stucco
