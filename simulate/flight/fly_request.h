// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "simulate/scene/scene_folder.h"

namespace stucco::simulate {

struct FlyRequest {
  std::filesystem::path scene;   // a scene folder or a model
  ModelReading reading;          // for models
  std::filesystem::path plan;    // plan.json, or a survey folder with plan/plan.json
  std::filesystem::path survey;  // photos/ and truth/ are made in it
  int threads = 0;
};

struct FlySummary {
  int photos = 0;
  int lost = 0;
  int held_out = 0;
  int rendered = 0;       // the others were there from an earlier call
  double megapixels = 0;  // of the rendered ones
  double render_s = 0;
  double cpu_s = 0;                // of all threads in that time, encoding and all
  std::vector<std::string> notes;  // what to know about the result
};

}  // namespace stucco::simulate
