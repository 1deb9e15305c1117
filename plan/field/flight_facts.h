// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "site/terrain_grid.h"
#include "survey/plan.h"

namespace stucco::plan {

// What a pilot asks about a flight beyond what the plan says of it.
struct FlightFacts {
  int stops = 0;
  int photos = 0;
  double lowest_m = 0;  // above the ground right below, of its points in the air
  double highest_m = 0;
  double farthest_m = 0;  // from its take-off point, on the map
};

// By flight.
std::vector<FlightFacts> FactsOf(const Plan& plan, const TerrainGrid& terrain);

}  // namespace stucco::plan
