// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "survey/calibration.h"
#include "survey/captures.h"
#include "survey/georef.h"
#include "survey/plan.h"
#include "survey/proxy.h"
#include "survey/stage.h"
#include "survey/survey_photo.h"
#include "survey/texture_set.h"

namespace stucco {

// A result that is there but cannot be read.
struct DamagedFile {
  std::string stage;
  std::string file;  // relative to the survey folder
  std::string why;
};

// Everything the report is made of, as far as it exists.
struct SurveyData {
  std::optional<Plan> plan;
  std::optional<Captures> captures;
  std::optional<Calibration> calibration;
  std::optional<Georef> georef;
  std::optional<Proxy> proxy;
  std::optional<TextureSet> textures;
  std::set<std::string> elevations;  // buildings, by id, of which there is an elevation
  std::vector<SurveyPhoto> photos;   // whose poses are known
  std::vector<DamagedFile> damaged;
  std::vector<StageStatus> statuses;  // of the stages before the report, in their order
  bool metric = false;                // lengths are metres
};

// Reads what is there but for the plan. Never throws for what the folder holds.
SurveyData LoadSurvey(const std::filesystem::path& survey,
                      const std::vector<StageStatus>& statuses);

// Something the reader of the report must know before anything else.
struct Attention {
  std::string stage;
  std::string state;    // failed, stale, missing, damaged
  std::string why;      // may be empty
  std::string remedy;   // may be empty
  std::string command;  // what to type next
};

// What failed or is not there, the first cause first; empty when the survey is complete.
std::vector<Attention> FindAttention(const SurveyData& data);

// A photo that is in no texture, and the reason.
struct LeftOutPhoto {
  std::string path;
  std::string what;  // "unusable", "duplicate", "not posed"
  std::string why;
};

std::vector<LeftOutPhoto> LeftOutPhotos(const SurveyData& data);

}  // namespace stucco
