// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/verbs/internal/export_files.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <system_error>

#include "survey/error.h"
#include "survey/files.h"

namespace stucco {

namespace fs = std::filesystem;

void RequireFree(const fs::path& out, bool overwrite) {
  std::error_code error;
  if (!overwrite && fs::exists(out, error) && !(fs::is_directory(out) && fs::is_empty(out))) {
    throw Error(ErrorKind::kBadInput, fmt::format("{}: exists already", out.string()),
                "choose another name, or add --overwrite");
  }
}

std::vector<std::string> NotesOf(const SurveyLooks& looks) {
  if (looks.outdated.empty()) return {};
  return {
      fmt::format("epochs of an earlier model left out: {}; made again from their photos: stucco "
                  "texture SURVEY --epoch {}",
                  fmt::join(looks.outdated, ", "), looks.outdated.front())};
}

void CopyFile(const fs::path& from, const fs::path& to) {
  std::error_code error;
  if (!to.parent_path().empty()) {
    fs::create_directories(to.parent_path(), error);
  }
  WriteFileAtomically(to, ReadFile(from));
}

}  // namespace stucco
