// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <random>
#include <set>

#include "plan/match/connectivity.h"

namespace stucco::plan {
namespace {

using Edges = std::vector<std::pair<int, int>>;

TEST(Connectivity, ARingHasNoBridge) {
  const Connectivity ring = ConnectivityOf(4, {{0, 1}, {1, 2}, {2, 3}, {0, 3}});
  EXPECT_EQ(ring.parts, 1);
  EXPECT_EQ(ring.blocks, 1);
  EXPECT_TRUE(ring.bridges.empty());
}

TEST(Connectivity, TwoRingsHangByOneEdge) {
  const Connectivity both =
      ConnectivityOf(6, {{0, 1}, {1, 2}, {0, 2}, {3, 4}, {4, 5}, {3, 5}, {5, 2}});
  EXPECT_EQ(both.parts, 1);
  EXPECT_EQ(both.blocks, 2);
  EXPECT_EQ(both.bridges, (Edges{{2, 5}}));
  EXPECT_EQ(both.block[0], both.block[2]);
  EXPECT_NE(both.block[2], both.block[5]);
}

TEST(Connectivity, LoneNodesArePartsOfTheirOwn) {
  const Connectivity lone = ConnectivityOf(3, {{0, 2}});
  EXPECT_EQ(lone.parts, 2);
  EXPECT_EQ(lone.blocks, 3);
  EXPECT_EQ(lone.bridges, (Edges{{0, 2}}));
  EXPECT_EQ(ConnectivityOf(0, {}).parts, 0);
}

// A bridge is what leaves more parts when it is cut.
TEST(Connectivity, AgreesWithCuttingEveryEdge) {
  std::mt19937 random(1);
  for (int trial = 0; trial < 200; ++trial) {
    const int nodes = 2 + static_cast<int>(random() % 12);
    std::set<std::pair<int, int>> set;
    for (int i = 0; i < nodes + 2; ++i) {
      const int a = static_cast<int>(random() % nodes), b = static_cast<int>(random() % nodes);
      if (a != b) set.emplace(std::min(a, b), std::max(a, b));
    }
    const Edges edges(set.begin(), set.end());
    const Connectivity whole = ConnectivityOf(nodes, edges);
    Edges bridges;
    for (const auto& edge : edges) {
      Edges rest = edges;
      std::erase(rest, edge);
      if (ConnectivityOf(nodes, rest).parts > whole.parts) bridges.push_back(edge);
    }
    EXPECT_EQ(whole.bridges, bridges) << trial;
  }
}

}  // namespace
}  // namespace stucco::plan
