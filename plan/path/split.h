// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

namespace stucco::plan {

// A closed tour to cut into flights.
struct SplitProblem {
  std::vector<double> home_m;  // from home to each stop, in the tour's order
  std::vector<double> next_m;  // from each stop to the next, the last to the first
  double length_budget_m = 0;  // of a flight without stops
  double stop_length_m = 0;    // the length that uses as much battery as a stop
};

// Stops first .. first + count - 1 (modulo the number of stops) from home to home.
struct Stretch {
  int first = 0;
  int count = 0;
};

// As few flights as possible in the tour's order, and among those the shortest in total; where the
// first begins is free (all starts within one flight's reach are tried, or many of them evenly on
// big tours). Each stop must fit a flight of its own.
std::vector<Stretch> SplitTour(const SplitProblem& problem);

}  // namespace stucco::plan
