// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/verbs/internal/publish_import.h"

#include <fmt/format.h>

#include "pipeline/engine/hash_cache.h"
#include "pipeline/engine/lock.h"
#include "pipeline/engine/outputs.h"
#include "pipeline/engine/run_stage.h"
#include "pipeline/engine/work_folder.h"

namespace stucco {

namespace fs = std::filesystem;

std::vector<std::string> PublishImport(const fs::path& survey, const std::string& stage,
                                       const fs::path& source, const Platform& platform,
                                       const std::function<void(const fs::path& out)>& write) {
  std::vector<std::string> notes;
  const SurveyLock lock(survey, fmt::format("import {}", source.string()), platform);
  if (!lock.held()) {
    notes.emplace_back("this file system has no locks; start no run at the same time");
  }
  CleanScratch(survey);
  ScratchFolder scratch(survey, stage);
  write(scratch.path());
  if (const auto moved = scratch.Publish(platform)) {
    notes.push_back(
        fmt::format("a folder {} that stucco did not make is now {}", stage, moved->string()));
  }
  const WorkFolder work(survey);
  HashCache hashes(work.Hashes());
  Manifest manifest;
  manifest.stage = stage;
  manifest.program = ProgramVersion();
  manifest.outputs = HashOutputs(survey, stage, 1, hashes);
  manifest.imported_from = fs::absolute(source).lexically_normal().string();
  WriteManifest(manifest, work.Manifest(stage));
  hashes.Save();
  std::error_code ignored;
  fs::remove(work.Failure(stage), ignored);
  return notes;
}

}  // namespace stucco
