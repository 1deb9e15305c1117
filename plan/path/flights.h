// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "plan/camera/hover.h"
#include "plan/path/tour.h"
#include "site/site.h"
#include "survey/plan.h"
#include "survey/stage.h"

namespace stucco::plan {

struct FlightPlan {
  std::vector<Hover> hovers;  // in order of capture
  // Waypoints name hovers by index. Each flight begins and ends above its home at the lowest
  // altitude; its length includes the climb there and back.
  std::vector<PlannedFlight> flights;
  TourReport tour;
  double length_m = 0;  // of all flights
  double time_min = 0;
  double battery_percent = 0;  // of one battery: 250 is two and a half
};

struct Battery {
  double scale = 1;         // batteries of a Mavic 3E that it is worth
  double use_percent = 80;  // that one flight may use, less what its way home takes
  PlannedPace pace = {};
};

// The order of the hovers and the flights that visit them: a nearly cheapest tour, cut into flights
// along the shortest safe paths. Each uses at most `battery.use_percent` of a battery less what the
// way home from its farthest stop takes against the wind; it starts and lands at home or, where the
// site has others (Site::take_off), at the place with the cheapest ways. Few flights come first,
// then little energy and facades whose photos are taken in one flight. Hovers
// that no-fly polygons cut off from home are left out with a warning. Throws Error: kBadInput where
// home is not free or a hover too far for one battery, kStageFailed where a hover is not free.
FlightPlan PlanFlights(const Site& site, const Battery& battery, std::vector<Hover> hovers,
                       int threads, Progress& progress);

}  // namespace stucco::plan
