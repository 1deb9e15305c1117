// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "calib/expect/expected_views.h"
#include "calib/features/wall_features.h"
#include "calib/options/calib_options.h"
#include "survey/captures.h"
#include "survey/plan.h"
#include "survey/stage.h"

namespace stucco {

// What the plan lets the search for matches expect.
struct Guidance {
  std::optional<ExpectedViews> views;             // nothing without a plan
  std::vector<PlannedFacade> facades;             // its walls
  std::vector<PlannedFootprint> footprints;       // its buildings and obstacles
  std::vector<std::pair<int, int>> pairs;         // that should overlap
  std::vector<WallPair> wall_pairs;               // to match on a rectified wall
  std::map<std::pair<int, int>, WallView> walls;  // of (photo, wall) in wall_pairs
};

// Empty where the survey has no plan.
Guidance GuideByPlan(const CalibOptions& options, const Captures& captures,
                     const std::vector<const CapturedPhoto*>& photos, const StageContext& context);

}  // namespace stucco
