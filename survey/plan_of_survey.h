// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "survey/plan.h"
#include "survey/stage.h"

namespace stucco {

// The plan that the survey was flown by; nothing where there is none and, with a warning, where it
// cannot be read: a plan is a prior, and a survey without one is as good as any other.
std::optional<Plan> PlanOfSurvey(const StageContext& context);

}  // namespace stucco
