// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/path/tour.h"

#include <algorithm>
#include <numeric>

#include "plan/path/greedy.h"
#include "plan/path/local_search.h"
#include "plan/path/shot_order.h"
#include "plan/path/tour_bound.h"
#include "plan/path/tour_parts.h"
#include "survey/parallel.h"

namespace stucco::plan {
namespace {

// Up to here all orders are tried.
constexpr size_t kMostTried = 7;
// Perturbations per hover, and at most: what they gain falls off, what they cost does not.
constexpr size_t kPerturbationsPerHover = 12;
constexpr size_t kMostPerturbations = 100000;
// From so many hovers on the most part of the perturbations, once and again, goes to stretches of
// the tour of up to so many hovers, which are searched at once; there, fewer gain as much.
constexpr size_t kWorthParts = 1000;
constexpr int kMostOfPart = 1500;
constexpr double kShareOfParts = 0.45;
constexpr size_t kPerturbationsPerHoverInParts = 8;

Order BestOfAll(int hovers, PortCosts& costs) {
  Order order;
  order.hovers.resize(hovers);
  order.reversed.assign(hovers, 0);
  std::iota(order.hovers.begin(), order.hovers.end(), 0);
  if (hovers < 2) return order;
  Order best = order;
  ChooseDirections(best, costs);
  double least = TourCost(best, costs);
  while (std::next_permutation(order.hovers.begin() + 1, order.hovers.end())) {
    if (order.hovers[1] > order.hovers.back()) continue;  // the same tour backwards
    Order trial = order;
    ChooseDirections(trial, costs);
    const double cost = TourCost(trial, costs);
    if (cost < least) {
      least = cost;
      best = trial;
    }
  }
  return best;
}

// The tour before perturbation: nearly as good, and soon there.
Order FirstTour(const HoverCosts& hover_costs,
                std::span<const std::vector<TourCandidate>> candidates, PortCosts& costs) {
  if (candidates.size() <= kMostTried) return BestOfAll(hover_costs.size(), costs);
  Order order{GreedyTour(hover_costs, candidates), std::vector<char>(candidates.size())};
  ChooseDirections(order, costs);
  TourSearch search(costs, candidates, order);
  search.Improve();
  return search.Result();
}

int PerturbationsOf(size_t hovers) {
  if (hovers <= kMostTried) return 0;
  const size_t each = hovers < kWorthParts ? kPerturbationsPerHover : kPerturbationsPerHoverInParts;
  return static_cast<int>(std::min(each * hovers, kMostPerturbations));
}

// Stretches first, twice with other ends; then the whole, as stretches lie beside each other.
Order BestFrom(Order order, const TourProblem& problem, PortCosts& costs, int threads,
               Progress& progress) {
  const size_t n = problem.hovers.size();
  int perturbations = PerturbationsOf(n);
  if (perturbations == 0) return order;
  if (n >= kWorthParts) {
    const int parts = 2 * (1 + static_cast<int>(n) / (2 * kMostOfPart));
    const int share = static_cast<int>(kShareOfParts * perturbations);
    for (const size_t first : {size_t{0}, n / (2 * static_cast<size_t>(parts))}) {
      order = PerturbedInParts(problem, order, {parts, first, share}, threads, progress);
      perturbations -= share;
    }
  }
  order = Perturbed(problem.candidates, order, perturbations, costs, progress);
  ChooseDirections(order, costs);
  return order;
}

}  // namespace

Tour PlanTour(const SafeSpace& space, std::vector<Hover> hovers, int threads, Progress& progress) {
  progress.Begin("order of the photos", static_cast<size_t>(PerturbationsOf(hovers.size())));
  ParallelFor(hovers.size(), threads, [&](size_t k) { OrderShots(hovers[k].shots); });
  const HoverCosts hover_costs(space, hovers);
  const auto candidates = FindCandidates(hover_costs, threads);
  PortCosts costs(hover_costs, candidates);
  Order order = FirstTour(hover_costs, candidates, costs);
  const double first_cost = TourCost(order, costs);
  Tour tour;
  // The bound needs a tour only for the length of its steps, so both go on at once.
  ParallelFor(2, threads, [&](size_t task) {
    if (task == 0) {
      order = BestFrom(order, {space, hovers, candidates}, costs, threads, progress);
    }
    if (task == 1) tour.report.lower_bound = TourLowerBound(hover_costs, candidates, first_cost);
  });
  tour.report.cost = TourCost(order, costs);
  tour.given = order.hovers;
  for (const int k : order.hovers) {
    tour.hovers.push_back(hovers[k]);
    auto& shots = tour.hovers.back().shots;
    if (order.reversed[k]) std::reverse(shots.begin(), shots.end());
  }
  return tour;
}

}  // namespace stucco::plan
