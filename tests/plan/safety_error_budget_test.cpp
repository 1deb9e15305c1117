// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>

#include "plan/safety/error_budget.h"
#include "survey/error.h"

namespace stucco::plan {
namespace {

TEST(ErrorBudget, IsAPartOfTheDistance) {
  const ErrorBudget budget = BudgetOf({});
  EXPECT_NEAR(budget.horizontal_m, 1 + std::sqrt(8), 1e-12);
  EXPECT_NEAR(budget.vertical_m, 2 + std::sqrt(8), 1e-12);
  EXPECT_NEAR(budget.horizontal_m + budget.clear_horizontal_m, 10, 1e-12);
  EXPECT_NEAR(budget.vertical_m + budget.clear_vertical_m, 10, 1e-12);
  EXPECT_NEAR(budget.flatness_m, 5 - 2 - 2, 1e-12);  // what is left over the ground decides
}

TEST(ErrorBudget, FlatnessIsWhatRoofsAndGroundLeave) {
  PlanOptions options;
  options.min_altitude_m = 20;
  EXPECT_NEAR(BudgetOf(options).flatness_m, 10 - 2 - std::sqrt(8) - 2, 1e-12);
  options.min_altitude_m = 2;
  EXPECT_EQ(BudgetOf(options).flatness_m, 0);
}

TEST(ErrorBudget, MoreThanTheDistanceIsRefused) {
  PlanOptions options;
  EXPECT_NO_THROW(CheckBudget(options));
  options.d_min_m = 5;
  EXPECT_NO_THROW(CheckBudget(options));
  options.d_min_m = 4.8;
  EXPECT_THROW(CheckBudget(options), Error);  // vertically
  options.height_error_m = 0;
  EXPECT_NO_THROW(CheckBudget(options));
  options.map_error_m = 10;
  EXPECT_THROW(CheckBudget(options), Error);  // horizontally
  options.map_error_m = std::nan("");
  EXPECT_THROW(CheckBudget(options), Error);
}

}  // namespace
}  // namespace stucco::plan
