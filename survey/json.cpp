// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/internal/json.h"

#include <string>

#include "survey/files.h"

namespace stucco::internal {
namespace {

// "[json.exception.parse_error.101] parse error at line 1 ..." without the part for programmers.
std::string Reason(const Json::exception& error) {
  const std::string text = error.what();
  const size_t end = text.find("] ");
  return end == std::string::npos ? text : text.substr(end + 2);
}

}  // namespace

Json LoadJson(const std::filesystem::path& path) {
  const std::string bytes = ReadFile(path);
  Json json;
  try {
    json = Json::parse(bytes);
  } catch (const Json::exception& error) {
    throw Error(ErrorKind::kBadInput,
                fmt::format("{}: is not valid JSON: {}", path.string(), Reason(error)));
  }
  int version = 0;
  const std::string file = path.string();
  const JsonReader reader(json, file, "");
  reader.Required("version", version);
  if (version != kJsonVersion) {
    throw Error(ErrorKind::kBadInput,
                fmt::format("{}: \"version\" is {}, but this program reads version {}", file,
                            version, kJsonVersion),
                "run the stage that writes this file again");
  }
  return json;
}

void SaveJson(const Json& json, const std::filesystem::path& path) {
  std::string text;
  try {
    text = json.dump(2);
  } catch (const Json::exception& error) {
    // The only texts that come from outside are file names and photo metadata.
    throw Error(ErrorKind::kBadInput,
                fmt::format("{}: cannot be written: {}", path.string(), Reason(error)),
                "rename photos whose names are not UTF-8");
  }
  text += '\n';
  WriteFile(path, text);
}

}  // namespace stucco::internal
