// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <utility>
#include <vector>

#include "survey/captures.h"
#include "survey/plan.h"
#include "survey/stage.h"

namespace stucco {

// Pairs (a, b), a < b, ascending, of photos whose planned views are meant for overlapping parts of
// one facade, or were taken from one hover. They are worth matching however large the survey is.
std::vector<std::pair<int, int>> PairsOfPlan(const Plan& plan,
                                             const std::vector<const CapturedPhoto*>& photos);

// The same with the survey's plan; none, with a warning, when it cannot be read.
std::vector<std::pair<int, int>> PlannedPairs(const StageContext& context,
                                              const std::vector<const CapturedPhoto*>& photos);

}  // namespace stucco
