// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "survey/options.h"
#include "survey/stage.h"

namespace stucco {

// A stage with its options: `options` points into what `run` reads.
struct BoundStage {
  OptionTable options;
  std::function<void(StageContext&)> run;
};

// What a stage costs, for the estimates of `check`. Rough by nature: CPU seconds are of a 3 GHz
// core and of ordinary outdoor photos. Megapixels are those of photos reduced to the stage's option
// `max_image_px`, where it has one.
struct StageCost {
  double cpu_s_per_photo = 0;
  double cpu_s_per_megapixel = 0;
  double cpu_s_per_pair = 0;  // of photos that are compared
  double disk_mb_per_photo = 0;
  double disk_mb_per_megapixel = 0;
  double memory_mb = 0;
  double memory_mb_per_photo = 0;
  double memory_mb_per_megapixel = 0;  // of all photos
  double memory_mb_per_largest_megapixel = 0;
  // Of the largest photo, for each thread, as far as the memory limit's share allows.
  double thread_mb_per_largest_megapixel = 0;
  double threads_share = 0.25;         // of run.memory_limit_gb; one thread needs what it needs
  double cached_mb_per_megapixel = 0;  // of all photos, as far as the memory limit's share allows
  double cached_share = 0;             // of run.memory_limit_gb
};

// One row of the stage table: everything the orchestrator knows about a stage.
struct Stage {
  std::string name;                 // also its folder in the survey and its section in survey.toml
  std::string title;                // what it makes, for people: "camera poses"
  int version = 1;                  // raised when the same input gives another output
  std::vector<std::string> needs;   // stages that have to be done before
  std::vector<std::string> inputs;  // files or whole folders it reads, relative to the survey
  bool photos_are_input = false;    // every file of the photo folder is an input
  bool opens_photos = false;        // cannot run while the photo folder is away
  bool reports_failures = false;    // runs also when a stage that it needs failed
  StageCost cost;
  std::function<BoundStage()> bind;  // a fresh set of options at their defaults
};

// In an order in which they can run.
using StageTable = std::vector<Stage>;

// Ties a stage's options, Describe and Run functions together.
template <typename Options>
BoundStage Bind(const std::string& section, void (*describe)(OptionTable&, Options&),
                void (*run)(const Options&, StageContext&)) {
  auto options = std::make_shared<Options>();
  BoundStage bound{OptionTable(section),
                   [options, run](StageContext& context) { run(*options, context); }};
  describe(bound.options, *options);
  return bound;
}

// Throws Error (kUsage) with the nearest name when there is no such stage.
const Stage& GetStage(const StageTable& table, std::string_view name);

// The stage and all that it needs, directly or not, in the table's order.
std::vector<std::string> WithNeeds(const StageTable& table, std::string_view name);

// What makes a table unusable: a stage listed twice, or needing one that does not stand before it.
// Empty for a good one.
std::string FindProblem(const StageTable& table);

}  // namespace stucco
