// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "pipeline/engine/platform.h"

namespace stucco {

// The folder in which a stage writes: `.stucco/scratch/<stage>-<pid>`. Removed with all that is in
// it unless it was published.
class ScratchFolder {
 public:
  // Throws Error (kBadInput) when the survey cannot be written.
  ScratchFolder(const std::filesystem::path& survey, const std::string& stage);
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

  // Flushes every file to disk and puts the folder in the place of survey/<stage> in one step: at
  // any moment there is the whole old folder or the whole new one. What was there is removed when
  // this program made it; anything else is the user's and is moved to survey/<stage>.old-N, which
  // is returned. Throws Error.
  std::optional<std::filesystem::path> Publish(const Platform& platform);

 private:
  std::filesystem::path survey_;
  std::string stage_;
  std::filesystem::path path_;
  std::filesystem::path target_;
};

// Notes that survey/<stage> is made by this program, as its manifest does: for outputs whose
// manifest is not yet written or not there any more. Throws Error.
void MarkAsOurs(const std::filesystem::path& survey, const std::string& stage);

// Removes what killed runs left behind, and restores outputs that a kill caught half way of being
// replaced on a file system that cannot exchange two folders. Call it with the lock held. Throws
// Error where these cannot be put back.
void CleanScratch(const std::filesystem::path& survey);

}  // namespace stucco
