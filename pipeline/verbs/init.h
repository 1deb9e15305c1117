// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "pipeline/engine/stages.h"
#include "pipeline/verbs/photos.h"

namespace stucco {

// Creates a survey folder with a survey.toml that names the photo folder, relative when it lies
// inside the survey. Returns what is in the photo folder. Throws Error (kBadInput), having
// created nothing, when there already is a survey, when the photo folder is not there, holds
// the survey or lies where a stage would replace it, when the folder has entries named like a
// stage, or when the survey cannot be written.
PhotoFolder InitSurvey(const std::filesystem::path& survey, const std::filesystem::path& photos,
                       const StageTable& table);

// Where a survey that was made without photos waits for them.
inline constexpr char kWaitingPhotos[] = "photos";

// Makes a folder a survey that waits for its photos in SURVEY/photos. What is in the folder already
// stays, and a folder that is a survey is left as it is. Throws Error (kBadInput).
void InitWaitingSurvey(const std::filesystem::path& survey, const StageTable& table);

}  // namespace stucco
