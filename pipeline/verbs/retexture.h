// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "pipeline/engine/console.h"
#include "pipeline/engine/platform.h"
#include "pipeline/engine/stages.h"
#include "survey/epoch.h"

namespace stucco {

struct RetextureRequest {
  std::filesystem::path photos;  // of another day; never written to
  std::string epoch;             // empty: as the photo folder is called
  ReplaceMode replace = ReplaceMode::kAuto;
  bool again = false;          // in the place of the epoch of that name
  int threads = 0;             // 0: as survey.toml says
  double memory_limit_gb = 0;  // likewise
  std::string command;         // as typed, for the lock
};

struct RetextureReport {
  std::filesystem::path folder;  // epochs/NAME of the survey
  Epoch epoch;
  // Where an epoch of that name was moved which this program did not make, or cannot know that it
  // did.
  std::optional<std::filesystem::path> moved;
};

// Places photos of another day in a finished survey and makes an epoch of it, a folder epochs/NAME
// with the pictures and the model as these photos show them (docs/retexture.md). Nothing else of
// the survey changes, and the folder is there whole or not at all: it is made in the scratch
// folder, and what an interrupted run has finished is used by the next. Throws Error: kUsage for a
// name that cannot be one; kBadInput where the survey has no textures yet, the epoch exists and was
// not to be made again, there is no new photo or what they are compared with is gone; kStageFailed
// where no photo can be placed, with the reasons.
RetextureReport RetextureSurvey(const std::filesystem::path& survey,
                                const RetextureRequest& request, const StageTable& table,
                                Console& console, const Platform& platform);

// Whether the folder of a survey's own photos is there. Throws Error (kBadInput).
bool HasPhotos(const std::filesystem::path& survey, const StageTable& table);

// Asks for an epoch that is there to be made again, from the same photos and by the same choice,
// on the survey as it has become. Throws Error (kBadInput) where there is no such epoch.
RetextureRequest SameAgain(const std::filesystem::path& survey, const std::string& epoch);

}  // namespace stucco
