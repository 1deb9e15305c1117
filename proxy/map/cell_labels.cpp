// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/map/cell_labels.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>

#include "survey/min_cut.h"

namespace stucco {
namespace {

// The best set of cells to take a label (Kolmogorov and Zabih, "What energy functions can be
// minimized via graph cuts?", 2004, section 4.1).
std::vector<int> Expanded(const CellProblem& problem, const std::vector<int>& labels, int grown) {
  constexpr double kScale = 1e9;  // sums stay exact in whole numbers up to 9e9 of cost
  const auto whole = [](double cost) { return static_cast<int64_t>(std::llround(cost * kScale)); };
  std::vector<FlowNode> nodes(labels.size());
  for (size_t i = 0; i < labels.size(); ++i) {
    nodes[i] = {.from_source = whole(problem.data[i][labels[i]]),
                .to_sink = whole(problem.data[i][grown])};
  }
  std::vector<FlowEdge> edges;
  const auto add = [&](int node, int64_t cost_of_growing) {
    if (cost_of_growing > 0) {
      nodes[node].to_sink += cost_of_growing;
    } else {
      nodes[node].from_source -= cost_of_growing;
    }
  };
  for (size_t l = 0; l < problem.links.size(); ++l) {
    const auto [i, j] = problem.links[l];
    const int64_t i_grows = whole(problem.border(l, grown, labels[j]));
    const int64_t j_grows = whole(problem.border(l, labels[i], grown));
    const int64_t kept =
        std::min(whole(problem.border(l, labels[i], labels[j])), i_grows + j_grows);
    add(i, i_grows - kept);
    add(j, -i_grows);
    edges.push_back({.a = static_cast<size_t>(i),
                     .b = static_cast<size_t>(j),
                     .there = 0,
                     .back = i_grows + j_grows - kept});
  }
  const std::vector<bool> grows = SourceSide(nodes, edges);
  std::vector<int> result = labels;
  for (size_t i = 0; i < labels.size(); ++i) {
    if (grows[i]) result[i] = grown;
  }
  return result;
}

}  // namespace

double EnergyOf(const CellProblem& problem, const std::vector<int>& labels) {
  double energy = 0;
  for (size_t i = 0; i < labels.size(); ++i) energy += problem.data[i][labels[i]];
  for (size_t l = 0; l < problem.links.size(); ++l) {
    energy += problem.border(l, labels[problem.links[l].a], labels[problem.links[l].b]);
  }
  return energy;
}

std::vector<int> CheapestCellLabels(const CellProblem& problem) {
  assert(problem.labels > 0);
  constexpr int kMostRounds = 8;
  constexpr double kSaving = 1e-9;
  std::vector<int> labels;
  for (const auto& costs : problem.data) {
    labels.push_back(static_cast<int>(std::ranges::min_element(costs) - costs.begin()));
  }
  double energy = EnergyOf(problem, labels);
  for (int round = 0; round < kMostRounds; ++round) {
    const double before = energy;
    for (int label = 0; label < problem.labels; ++label) {
      std::vector<int> tried = Expanded(problem, labels, label);
      const double cost = EnergyOf(problem, tried);
      if (!(cost < energy - kSaving)) continue;
      energy = cost;
      labels = std::move(tried);
    }
    if (!(energy < before - kSaving)) break;
  }
  return labels;
}

}  // namespace stucco
