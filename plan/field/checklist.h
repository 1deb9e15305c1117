// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "plan/field/field_facts.h"
#include "plan/output/stats.h"
#include "survey/plan.h"

namespace stucco::plan {

// plan/checklist.html: what a pilot takes to the site, on paper of A4. One page without scripts or
// anything from elsewhere.
std::string ChecklistHtml(const Plan& plan, const PlanStats& stats, const FieldFacts& facts);

}  // namespace stucco::plan
