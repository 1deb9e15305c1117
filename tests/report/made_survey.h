// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "survey/calibration.h"
#include "survey/captures.h"
#include "survey/georef.h"
#include "survey/proxy.h"
#include "survey/reconstruction.h"
#include "survey/texture_set.h"
#include "tests/survey/temporary_folder.h"

namespace stucco {

// The results of all stages for a made-up site of boxes with a gable, in memory so that a test can
// change them before they are written. Walls differ in quality: some good, some amber, some red.
struct MadeSurvey {
  Captures captures;
  Calibration calibration;
  Georef georef;
  Reconstruction sparse;
  Proxy proxy;
  TextureSet textures;
};

struct MadeSurveyOptions {
  int buildings = 3;
  bool metric = true;
};

MadeSurvey MakeSurvey(const MadeSurveyOptions& options = {});

// Writes every result, and pictures of walls with windows and label maps for the textures.
void WriteSurvey(const MadeSurvey& made, const std::filesystem::path& survey);

// Whether a page has a text: pages are too long for what a matcher prints.
bool Has(const std::string& page, const std::string& text);

}  // namespace stucco
