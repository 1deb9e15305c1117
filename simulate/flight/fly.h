// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "simulate/flight/options.h"
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

// Flies a plan through a scene: photos with the metadata that a drone writes into SURVEY/photos,
// the truth beside them. `progress` hears (0, total) when all input is known to be
// sound and nothing is written yet, then (done, total) after each photo, one call at a time; what
// it throws ends the flight. What an interrupted flight has finished is kept: the same call goes
// on; a call with other options or another scene replaces the photos of the flight before, and
// nobody else's. Throws Error (kBadInput): the plan is for another place, cameras stand inside
// buildings, the survey has another plan, photos of a real flight ...
FlySummary Fly(const FlyRequest& request, const FlightOptions& options,
               const std::function<void(size_t, size_t)>& progress);

}  // namespace stucco::simulate
