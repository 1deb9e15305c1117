// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/min_cut.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

namespace stucco {
namespace {

struct Problem {
  std::vector<FlowNode> nodes;
  std::vector<FlowEdge> edges;
};

// Of the cut that leaves the nodes of `side` with the source.
int64_t CostOf(const Problem& problem, const std::vector<bool>& side) {
  int64_t cost = 0;
  for (size_t i = 0; i < problem.nodes.size(); ++i) {
    cost += side[i] ? problem.nodes[i].to_sink : problem.nodes[i].from_source;
  }
  for (const FlowEdge& edge : problem.edges) {
    if (side[edge.a] && !side[edge.b]) cost += edge.there;
    if (side[edge.b] && !side[edge.a]) cost += edge.back;
  }
  return cost;
}

Problem RandomProblem(size_t nodes, std::mt19937_64& engine) {
  Problem problem;
  const auto draw = [&](uint64_t below) { return static_cast<int64_t>(engine() % below); };
  for (size_t i = 0; i < nodes; ++i) problem.nodes.push_back({draw(9), draw(9)});
  for (size_t a = 0; a < nodes; ++a) {
    for (size_t b = a + 1; b < nodes; ++b) {
      if (draw(10) < 4) problem.edges.push_back({a, b, draw(6), draw(6)});
    }
  }
  return problem;
}

TEST(SourceSide, IsTheSmallestSideOfACheapestCut) {
  std::mt19937_64 engine(12);
  constexpr size_t kNodes = 9;
  for (int round = 0; round < 60; ++round) {
    const Problem problem = RandomProblem(kNodes, engine);
    int64_t best = std::numeric_limits<int64_t>::max();
    std::vector<bool> smallest;  // what all cheapest cuts have in common
    for (int mask = 0; mask < 1 << kNodes; ++mask) {
      std::vector<bool> side(kNodes);
      for (size_t i = 0; i < kNodes; ++i) side[i] = (mask >> i & 1) != 0;
      const int64_t cost = CostOf(problem, side);
      if (cost > best) continue;
      if (cost < best) smallest.assign(kNodes, true);
      best = cost;
      for (size_t i = 0; i < kNodes; ++i) smallest[i] = smallest[i] && side[i];
    }
    const std::vector<bool> found = SourceSide(problem.nodes, problem.edges);
    EXPECT_EQ(CostOf(problem, found), best);
    EXPECT_EQ(found, smallest);
  }
}

TEST(SourceSide, EdgesHaveADirection) {
  const std::vector<FlowNode> nodes = {{5, 0}, {0, 2}};
  EXPECT_EQ(SourceSide(nodes, std::vector<FlowEdge>{{0, 1, 1, 0}}),
            (std::vector<bool>{true, false}));
  EXPECT_EQ(SourceSide(nodes, std::vector<FlowEdge>{{0, 1, 3, 0}}),
            (std::vector<bool>{true, true}));
  EXPECT_EQ(SourceSide(nodes, std::vector<FlowEdge>{{0, 1, 0, 3}}),
            (std::vector<bool>{true, false}));
}

TEST(SourceSide, WithoutCapacityNothingIsOnIt) {
  EXPECT_TRUE(SourceSide({}, {}).empty());
  EXPECT_EQ(SourceSide(std::vector<FlowNode>(3), {}), std::vector<bool>(3, false));
}

}  // namespace
}  // namespace stucco
