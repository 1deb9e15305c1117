// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/safety/error_budget.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "survey/error.h"

namespace stucco::plan {

ErrorBudget BudgetOf(const PlanOptions& options) {
  ErrorBudget budget;
  budget.horizontal_m = kEaves_m + std::hypot(options.map_error_m, options.position_error_m);
  budget.vertical_m =
      kRoofStructures_m + std::hypot(options.height_error_m, options.position_error_m);
  budget.clear_horizontal_m = options.d_min_m - budget.horizontal_m;
  budget.clear_vertical_m = options.d_min_m - budget.vertical_m;
  const double above_ground = options.min_altitude_m - options.position_error_m;
  budget.flatness_m =
      std::max(0.0, std::min(budget.clear_vertical_m, above_ground) - kLeastClear_m);
  return budget;
}

void CheckBudget(const PlanOptions& options) {
  const ErrorBudget budget = BudgetOf(options);
  if (budget.clear_horizontal_m > 0 && budget.clear_vertical_m > 0) return;
  throw Error(
      ErrorKind::kUsage,
      fmt::format(
          "--d-min {:g}: may be used up by errors of {:.1f} m horizontally (outlines of the "
          "map {:g} m, the drone {:g} m, eaves {:g} m) and {:.1f} m vertically (heights of "
          "the map {:g} m, the drone {:g} m, antennas {:g} m)",
          options.d_min_m, budget.horizontal_m, options.map_error_m, options.position_error_m,
          kEaves_m, budget.vertical_m, options.height_error_m, options.position_error_m,
          kRoofStructures_m),
      "give a larger --d-min; or say what is better known, as --position-error 0.2 for a drone "
      "with "
      "RTK, --map-error 0.3 and --height-error 0.5 for a surveyed map");
}

}  // namespace stucco::plan
