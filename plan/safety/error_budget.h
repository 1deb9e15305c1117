// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "plan/options/plan_options.h"

namespace stucco::plan {

// Below this much air between a drone and anything, wind and a late stop are enough to meet it.
inline constexpr double kLeastClear_m = 2;
// What no map has: eaves stand out over the walls, chimneys and antennas over roofs (the height of
// a building leaves them out by the rules of OpenStreetMap).
inline constexpr double kEaves_m = 1;
inline constexpr double kRoofStructures_m = 2;

// How much of d_min may be used up by errors, and what is left. The errors of the map and of the
// drone know nothing of each other, so that their squares add up; eaves and antennas are there
// every time, and come on top.
struct ErrorBudget {
  double horizontal_m = 0;
  double vertical_m = 0;
  double clear_horizontal_m = 0;  // d_min less the error
  double clear_vertical_m = 0;
  // Without a terrain: how far the ground may rise above that of the take-off point until
  // kLeastClear_m are left nowhere, above roofs or above the ground. 0 where nothing is left.
  double flatness_m = 0;
};

ErrorBudget BudgetOf(const PlanOptions& options);

// Throws Error (kUsage) where the errors are larger than d_min: such a plan could fly into a wall.
void CheckBudget(const PlanOptions& options);

}  // namespace stucco::plan
