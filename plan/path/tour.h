// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "plan/camera/hover.h"
#include "plan/space/safe_space.h"
#include "survey/stage.h"

namespace stucco::plan {

// How good a tour is: `lower_bound` is what no tour can cost less than.
struct TourReport {
  double cost = 0;
  double lower_bound = 0;
  double gap() const { return lower_bound > 0 ? cost / lower_bound - 1 : 0; }
};

struct Tour {
  std::vector<Hover> hovers;  // in order, each with its photos in order
  std::vector<int> given;     // where each was in the input
  TourReport report;
};

// A closed tour over the hovers, nearly the cheapest (costs: see HoverCosts). The photos within a
// hover are ordered so that the camera turns little; the tour decides which end comes first. The
// same result at any number of threads. Throws Error (kInterrupted) when cancelled. All hovers must
// be free and able to reach each other.
Tour PlanTour(const SafeSpace& space, std::vector<Hover> hovers, int threads,
              Progress& progress = SilentProgress());

}  // namespace stucco::plan
