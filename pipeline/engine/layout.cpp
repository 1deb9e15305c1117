// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/engine/layout.h"

#include <fmt/format.h>

#include "survey/error.h"
#include "survey/survey_folder.h"

namespace stucco {
namespace {

namespace fs = std::filesystem;

void RequireOutside(const fs::path& photos, const fs::path& written) {
  if (IsInside(RealPath(photos), RealPath(written))) {
    throw Error(ErrorKind::kBadInput,
                fmt::format("{}: the photos lie in {}, which a run replaces", photos.string(),
                            written.string()),
                "move the photos to a folder of their own, beside the survey or in its folder "
                "photos");
  }
}

}  // namespace

fs::path RealPath(const fs::path& path) {
  std::error_code error;
  fs::path real = fs::weakly_canonical(path, error);
  if (!error) {
    return real;
  }
  const fs::path absolute = fs::absolute(path, error);
  return (error ? path : absolute).lexically_normal();
}

bool IsInside(const fs::path& path, const fs::path& folder) {
  const fs::path relative = path.lexically_relative(folder);
  return !relative.empty() && *relative.begin() != "..";
}

void RequireApart(const fs::path& survey, const fs::path& photos, const StageTable& table) {
  // Photos are never written to; a survey among them would be, and its pictures would count as
  // photos.
  if (IsInside(RealPath(survey), RealPath(photos))) {
    throw Error(ErrorKind::kBadInput,
                fmt::format("{}: the survey lies inside the photo folder {}", survey.string(),
                            photos.string()),
                "create the survey beside the photo folder; photos are never written to");
  }
  RequireOutside(photos, survey / kWorkFolder);
  for (const Stage& stage : table) {
    RequireOutside(photos, survey / stage.name);
  }
}

}  // namespace stucco
