// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

namespace stucco::plan {

// A place where flights may start, and what it costs from there, for each stop in the tour's order.
struct SplitHome {
  double fixed = 0;             // of any flight: take-off and landing
  std::vector<double> out;      // to the stop, infinite where there is no way
  std::vector<double> back;     // from it
  std::vector<double> reserve;  // to be left of the budget, the highest among a flight's stops
};

// A closed tour to cut into flights. All costs are of one unit.
struct SplitProblem {
  std::vector<SplitHome> homes;
  std::vector<double> stop;  // at each stop
  std::vector<double> next;  // from each stop to the next, the last to the first
  std::vector<double> cut;   // what it is worth not to cut between those two
  double budget = 0;         // of a flight, what it keeps in reserve included
};

// Stops first .. first + count - 1 (modulo the number of stops) from a home to the same home.
struct Stretch {
  int first = 0;
  int count = 0;
  int home = 0;
};

// As few flights as possible in the tour's order, and among those the cheapest in total, cuts
// included; where the first begins is free (all starts within one flight's reach are tried, or many
// of them evenly on big tours). Each stop must fit a flight of its own.
std::vector<Stretch> SplitTour(const SplitProblem& problem);

}  // namespace stucco::plan
