// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "plan/field/flight_facts.h"
#include "plan/field/ground_points.h"
#include "plan/field/sun_window.h"
#include "plan/mission/mission.h"

namespace stucco::plan {

// What the checklist has besides the plan.
struct FieldFacts {
  std::vector<FlightFacts> flights;  // by flight of the plan
  MissionFiles missions;
  std::vector<SunDay> days;
  std::vector<GroundPoint> ground_points;
};

}  // namespace stucco::plan
