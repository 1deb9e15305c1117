// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "site/site.h"
#include "survey/plan.h"

namespace stucco {

// The site as far as a plan tells: all but the terrain (see GroundRule), the area, the ceiling and
// what was mended in the map. Facades are those of the plan, in its order. Footprints without one
// are taken for obstacles.
Site SiteOfPlan(const Plan& plan);

}  // namespace stucco
