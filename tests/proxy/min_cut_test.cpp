// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/facets/min_cut.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

namespace stucco {
namespace {

double Cost(const std::vector<CutNode>& nodes, const std::vector<CutLink>& links,
            const std::vector<bool>& labels) {
  double cost = 0;
  for (size_t i = 0; i < nodes.size(); ++i) {
    cost += labels[i] ? nodes[i].cost_in : nodes[i].cost_out;
  }
  for (const CutLink& link : links) {
    if (labels[link.a] != labels[link.b]) cost += link.cost;
  }
  return cost;
}

TEST(CheapestLabels, FindsTheOptimumOfSmallRandomProblems) {
  std::mt19937_64 engine(11);
  const auto uniform = [&] { return double(engine() >> 11) * 0x1p-53; };
  for (int round = 0; round < 40; ++round) {
    constexpr int kNodes = 9;
    std::vector<CutNode> nodes(kNodes);
    for (CutNode& node : nodes) node = {uniform(), uniform()};
    std::vector<CutLink> links;
    for (int a = 0; a < kNodes; ++a) {
      for (int b = a + 1; b < kNodes; ++b) {
        if (uniform() < 0.4) links.push_back({a, b, 0.7 * uniform()});
      }
    }
    double best = std::numeric_limits<double>::infinity();
    for (int mask = 0; mask < 1 << kNodes; ++mask) {
      std::vector<bool> labels(kNodes);
      for (int i = 0; i < kNodes; ++i) labels[i] = (mask >> i & 1) != 0;
      best = std::min(best, Cost(nodes, links, labels));
    }
    EXPECT_NEAR(Cost(nodes, links, CheapestLabels(nodes, links)), best, 1e-9);
  }
}

TEST(CheapestLabels, WithoutCostsOrNodesNothingIsIn) {
  EXPECT_TRUE(CheapestLabels({}, {}).empty());
  EXPECT_EQ(CheapestLabels(std::vector<CutNode>(3), {}), std::vector<bool>(3, false));
}

}  // namespace
}  // namespace stucco
