// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/path/tour_parts.h"

#include <algorithm>
#include <random>

#include "plan/path/local_search.h"
#include "survey/error.h"
#include "survey/parallel.h"

namespace stucco::plan {
namespace {

constexpr int kPerturbationsPerReport = 500;

// A stretch of a tour as a problem of its own: its hovers are numbered as they follow each other.
struct Part {
  std::vector<int> given;  // their numbers in the whole
  std::vector<Hover> hovers;
  std::vector<std::vector<TourCandidate>> candidates;
  Order order;
};

Part SectionOf(const TourProblem& problem, const Order& tour, size_t from, size_t count) {
  Part part;
  std::vector<int> place(problem.hovers.size(), -1);
  for (size_t k = 0; k < count; ++k) {
    const int hover = tour.hovers[(from + k) % tour.hovers.size()];
    place[hover] = static_cast<int>(k);
    part.given.push_back(hover);
    part.hovers.push_back(problem.hovers[hover]);
    part.order.hovers.push_back(static_cast<int>(k));
    part.order.reversed.push_back(tour.reversed[hover]);
  }
  for (const int hover : part.given) {
    auto& candidates = part.candidates.emplace_back();
    for (TourCandidate candidate : problem.candidates[hover]) {
      candidate.hover = place[candidate.hover];
      if (candidate.hover >= 0) candidates.push_back(candidate);
    }
  }
  return part;
}

// The order read the other way round.
void ReadBackwards(Order& order) {
  std::ranges::reverse(order.hovers);
  for (char& reversed : order.reversed) reversed ^= 1;
}

// The order that begins with hover 0 and ends with the last, which follow each other in it.
Order FromEndToEnd(Order order) {
  const int last = static_cast<int>(order.hovers.size()) - 1;
  if (order.hovers[(std::ranges::find(order.hovers, last) - order.hovers.begin() + 1) %
                   order.hovers.size()] != 0) {
    ReadBackwards(order);
  }
  std::rotate(order.hovers.begin(), std::ranges::find(order.hovers, 0), order.hovers.end());
  return order;
}

// A path from the first to the last hover is a tour with an edge between the two that is held.
void Improve(const SafeSpace& space, int perturbations, Part& part, Progress& progress) {
  const HoverCosts hover_costs(space, part.hovers);
  PortCosts costs(hover_costs, part.candidates);
  costs.Hold(part.order.LastPort(part.order.hovers.back()),
             part.order.FirstPort(part.order.hovers.front()));
  part.order = FromEndToEnd(Perturbed(part.candidates, part.order, perturbations, costs, progress));
}

}  // namespace

Order Perturbed(std::span<const std::vector<TourCandidate>> candidates, const Order& start,
                int perturbations, PortCosts& costs, Progress& progress) {
  TourSearch search(costs, candidates, start);
  std::mt19937_64 random(candidates.size());
  for (int done = 0; done < perturbations; done += kPerturbationsPerReport) {
    if (progress.Cancelled()) throw Error(ErrorKind::kInterrupted, "interrupted");
    const int count = std::min(kPerturbationsPerReport, perturbations - done);
    search.Perturb(count, random);
    progress.Advance(static_cast<size_t>(count));
  }
  return search.Result();
}

Order PerturbedInParts(const TourProblem& problem, const Order& start, const TourParts& parts,
                       int threads, Progress& progress) {
  const size_t n = start.hovers.size();
  const auto begin_of = [&](size_t part) { return part * n / static_cast<size_t>(parts.parts); };
  std::vector<Part> stretches(parts.parts);
  ParallelFor(stretches.size(), threads, [&](size_t i) {
    const size_t count = begin_of(i + 1) - begin_of(i);
    stretches[i] = SectionOf(problem, start, parts.first + begin_of(i), count);
    const auto share = static_cast<int64_t>(count) * parts.perturbations / static_cast<int64_t>(n);
    Improve(problem.space, static_cast<int>(share), stretches[i], progress);
  });
  Order out{{}, start.reversed};
  for (const Part& part : stretches) {
    for (const int hover : part.order.hovers) {
      out.hovers.push_back(part.given[hover]);
      out.reversed[part.given[hover]] = part.order.reversed[hover];
    }
  }
  return out;
}

}  // namespace stucco::plan
