// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "site/site.h"
#include "survey/plan.h"

namespace stucco::plan {

// What a map tells of a place as a plan that nobody flies: its frame, footprints, no-fly polygons
// and facades, without camera, views and flights. In metres of the site's frame.
Plan PlanOfMap(const Site& site);

}  // namespace stucco::plan
