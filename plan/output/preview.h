// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "plan/output/stats.h"
#include "survey/plan.h"

namespace stucco::plan {

// plan/preview.svg: a map of the plan with a legend, for a surveyor to judge before flying.
std::string PreviewSvg(const Plan& plan, const PlanStats& stats);

}  // namespace stucco::plan
