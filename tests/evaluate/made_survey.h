// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "survey/pose.h"

namespace stucco::evaluate {

struct MadeSurvey {
  std::filesystem::path scene;
  std::filesystem::path survey;
};

// made_truth.h on disk below `root`: a scene folder, and a survey of it that has everything right
// up to the model, seen from a world of its own. Replaces what is there.
MadeSurvey WriteMadeSurvey(const std::filesystem::path& root, const Similarity& truth_from_world);

}  // namespace stucco::evaluate
