// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "plan/path/port_costs.h"
#include "survey/stage.h"

namespace stucco::plan {

// A tour to make better by perturbed local search (see TourSearch).
struct TourProblem {
  const SafeSpace& space;
  std::span<const Hover> hovers;
  std::span<const std::vector<TourCandidate>> candidates;  // by hover
};

// Perturbs the tour so many times. At least eight hovers. Throws Error (kInterrupted).
Order Perturbed(std::span<const std::vector<TourCandidate>> candidates, const Order& start,
                int perturbations, PortCosts& costs, Progress& progress);

// How a tour is cut: the first of so many stretches begins at a place of the tour; together they
// are perturbed so many times.
struct TourParts {
  int parts = 1;
  size_t first = 0;
  int perturbations = 0;
};

// Perturbs stretches of the tour, all of eight hovers or more, each by itself with its ends held,
// several at once: a stretch that gets cheaper makes the tour so. Tour segment partitioning:
// Helsgaun, "General k-opt submoves for the Lin-Kernighan TSP heuristic" (2009). The same at any
// number of threads. Throws Error (kInterrupted).
Order PerturbedInParts(const TourProblem& problem, const Order& start, const TourParts& parts,
                       int threads, Progress& progress);

}  // namespace stucco::plan
