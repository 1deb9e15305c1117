// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "plan/path/hover_costs.h"

namespace stucco::plan {

// A hover that may follow another in a good tour.
struct TourCandidate {
  int hover = 0;
  double length_m = 0;
  double cost = 0;  // of the best ports
};

// For each hover the cheapest others, cheapest first: ten by cost, and the nearest one in each
// quadrant around it, which keeps clusters connected.
std::vector<std::vector<TourCandidate>> FindCandidates(const HoverCosts& costs, int threads);

}  // namespace stucco::plan
