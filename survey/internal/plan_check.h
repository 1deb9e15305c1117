// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "survey/plan.h"

namespace stucco::internal {

// Ids of the facades that a view is meant for, each once, in the order of its targets.
std::vector<std::string> FacadesOf(const PlannedView& view);

// A target over all of a facade whose size is not known yet.
PlannedTarget WholeFacade(const std::string& facade);
// Gives such targets the size of their facade.
void ResolveWholeFacades(Plan& plan);

// Throws Error (kBadInput) that names the file and the entry when ids are used twice, something
// named does not exist or numbers make no sense.
void CheckPlan(const Plan& plan, const std::string& file);

}  // namespace stucco::internal
