// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/path/tour.h"

#include <algorithm>
#include <numeric>
#include <random>

#include "plan/path/greedy.h"
#include "plan/path/local_search.h"
#include "plan/path/shot_order.h"
#include "plan/path/tour_bound.h"
#include "survey/error.h"
#include "survey/parallel.h"

namespace stucco::plan {
namespace {

// Up to here all orders are tried.
constexpr size_t kMostTried = 7;
// Perturbations per hover, and at most: what they gain falls off, what they cost does not.
constexpr size_t kPerturbationsPerHover = 12;
constexpr size_t kMostPerturbations = 100000;
constexpr int kPerturbationsPerReport = 500;

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
  return static_cast<int>(std::min(kPerturbationsPerHover * hovers, kMostPerturbations));
}

Order Perturbed(const Order& start, std::span<const std::vector<TourCandidate>> candidates,
                PortCosts& costs, Progress& progress) {
  const int perturbations = PerturbationsOf(candidates.size());
  if (perturbations == 0) return start;
  TourSearch search(costs, candidates, start);
  std::mt19937_64 random(candidates.size());
  for (int done = 0; done < perturbations; done += kPerturbationsPerReport) {
    if (progress.Cancelled()) throw Error(ErrorKind::kInterrupted, "interrupted");
    search.Perturb(std::min(kPerturbationsPerReport, perturbations - done), random);
    progress.Advance();
  }
  Order order = search.Result();
  ChooseDirections(order, costs);
  return order;
}

}  // namespace

Tour PlanTour(const SafeSpace& space, std::vector<Hover> hovers, int threads, Progress& progress) {
  const int reports = PerturbationsOf(hovers.size()) / kPerturbationsPerReport + 1;
  progress.Begin("order of the photos", static_cast<size_t>(reports));
  ParallelFor(hovers.size(), threads, [&](size_t k) { OrderShots(hovers[k].shots); });
  const HoverCosts hover_costs(space, hovers);
  const auto candidates = FindCandidates(hover_costs, threads);
  PortCosts costs(hover_costs, candidates);
  Order order = FirstTour(hover_costs, candidates, costs);
  const double first_cost = TourCost(order, costs);
  Tour tour;
  // The bound needs a tour only for the length of its steps, so both go on at once.
  ParallelFor(2, threads, [&](size_t task) {
    if (task == 0) order = Perturbed(order, candidates, costs, progress);
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
