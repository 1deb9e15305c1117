// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "pipeline/engine/console.h"
#include "pipeline/engine/platform.h"
#include "pipeline/engine/stages.h"

namespace stucco {

// A survey while a simulator makes its photos: locked, with its photos in SURVEY/photos, and with
// progress on the console and in the event log.
class SimulatedSurvey {
 public:
  // A folder that is no survey yet becomes one that waits for its photos. `command` is for the
  // lock. Throws Error (kBadInput) when the survey's photos are elsewhere or another process works
  // on it.
  SimulatedSurvey(const std::filesystem::path& survey, const StageTable& table,
                  const std::string& command, Console& console, const Platform& platform);
  ~SimulatedSurvey();

  Progress& progress();

 private:
  struct Work;
  std::unique_ptr<Work> work_;
};

}  // namespace stucco
