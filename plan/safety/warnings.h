// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "plan/options/plan_options.h"
#include "site/site.h"
#include "survey/plan.h"

namespace stucco::plan {

// Above the ground. The open category of the EU (Implementing Regulation 2019/947, UAS.OPEN.010)
// and small drones in the US (14 CFR 107.51, 400 ft) end there.
inline constexpr double kLegalAltitude_m = 120;
// What street and garden trees usually reach; lamps and overhead wires are lower.
inline constexpr double kTreeHeight_m = 15;
// From the take-off point. A drone of 30 to 40 cm is a dot of 3 minutes of arc there, and its
// attitude cannot be told any more.
inline constexpr double kLineOfSight_m = 500;

// What somebody has to know before this plan is flown, a line each: what the site leaves open, flat
// ground assumed, too little left of d_min, flights too high, among trees, or out of sight.
std::vector<std::string> SafetyWarnings(const Site& site, const Plan& plan,
                                        const PlanOptions& options);

}  // namespace stucco::plan
