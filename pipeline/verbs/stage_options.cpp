// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/verbs/internal/stage_options.h"

#include <fmt/format.h>

#include "pipeline/engine/manifest.h"
#include "pipeline/engine/work_folder.h"

namespace stucco {

std::vector<std::string> OptionsAsMade(const std::filesystem::path& survey, const StageTable& table,
                                       const std::string& stage) {
  const auto manifest = ReadManifest(WorkFolder(survey).Manifest(stage)).manifest;
  if (!manifest) return {};
  const BoundStage bound = GetStage(table, stage).bind();
  std::vector<std::string> overrides;
  for (const auto& [name, toml] : manifest->fingerprint.options) {
    std::string text = toml;
    std::erase_if(text, [](char c) { return c == '"' || c == '[' || c == ']'; });
    if (bound.options.Find(name)) overrides.push_back(fmt::format("{}.{}={}", stage, name, text));
  }
  return overrides;
}

}  // namespace stucco
