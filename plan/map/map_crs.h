// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "plan/map/raw_map.h"
#include "survey/plan.h"
#include "survey/plan_frame.h"

namespace stucco::plan {

// The coordinate system that a map is in: its own, or `map_crs` where the map names none (or says
// degrees, as GeoJSON must, and has coordinates that are none). Throws Error where neither fits the
// coordinates.
std::string CrsOfMap(const RawMap& map, const std::string& map_crs);

// Replaces the coordinates of the map by those of the plan.
void MoveToPlan(RawMap& map, const std::string& crs, const PlanOrigin& origin);

// The middle of the map.
Geodetic MiddleOf(const RawMap& map, const std::string& crs);

}  // namespace stucco::plan
