// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <random>
#include <set>

#include "plan/match/connectivity.h"

namespace stucco::plan {
namespace {

// About as many edges as nodes, so that some hang by one and others do not.
Edges MadeEdges(int nodes, std::mt19937& random) {
  std::set<std::pair<int, int>> edges;
  for (int i = 0; i < nodes + 2; ++i) {
    const int a = static_cast<int>(random() % nodes), b = static_cast<int>(random() % nodes);
    if (a != b) edges.emplace(std::min(a, b), std::max(a, b));
  }
  return {edges.begin(), edges.end()};
}

TEST(Connectivity, ARingHasNoBridge) {
  const Connectivity ring = ConnectivityOf(4, {{0, 1}, {1, 2}, {2, 3}, {0, 3}});
  EXPECT_EQ(ring.parts, 1);
  EXPECT_TRUE(ring.bridges.empty());
}

TEST(Connectivity, TwoRingsHangByOneEdge) {
  const Connectivity both =
      ConnectivityOf(6, {{0, 1}, {1, 2}, {0, 2}, {3, 4}, {4, 5}, {3, 5}, {5, 2}});
  EXPECT_EQ(both.parts, 1);
  EXPECT_EQ(both.bridges, (Edges{{2, 5}}));
}

TEST(Connectivity, LoneNodesArePartsOfTheirOwn) {
  const Connectivity lone = ConnectivityOf(3, {{0, 2}});
  EXPECT_EQ(lone.parts, 2);
  EXPECT_EQ(lone.bridges, (Edges{{0, 2}}));
  EXPECT_EQ(ConnectivityOf(0, {}).parts, 0);
}

// A bridge is what leaves more parts when it is cut.
TEST(Connectivity, AgreesWithCuttingEveryEdge) {
  std::mt19937 random(1);
  for (int trial = 0; trial < 200; ++trial) {
    const int nodes = 2 + static_cast<int>(random() % 12);
    const Edges edges = MadeEdges(nodes, random);
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

TEST(HangingGroups, NothingHangsOnARing) {
  EXPECT_TRUE(HangingGroups(4, {{0, 1}, {1, 2}, {2, 3}, {0, 3}}).empty());
  EXPECT_TRUE(HangingGroups(0, {}).empty());
}

TEST(HangingGroups, ARingHangsOnAnotherThatSharesANodeWithIt) {
  const auto groups = HangingGroups(7, {{0, 1}, {1, 2}, {2, 3}, {0, 3}, {3, 4}, {4, 5}, {3, 5}});
  ASSERT_EQ(groups.size(), 2u);
  EXPECT_EQ(groups[0].nodes, (std::vector<int>{4, 5}));
  EXPECT_EQ(groups[0].on, 3);
  EXPECT_EQ(groups[1].nodes, (std::vector<int>{6}));
  EXPECT_EQ(groups[1].on, -1);
}

// Two groups that meet in the node that they hang on are two.
TEST(HangingGroups, GroupsOnOneNodeStayApart) {
  const auto groups = HangingGroups(7, {{0, 1}, {1, 2}, {0, 2}, {2, 3}, {3, 4}, {2, 5}, {5, 6}});
  ASSERT_EQ(groups.size(), 2u);
  for (const HangingGroup& group : groups) {
    EXPECT_EQ(group.nodes.size(), 2u);
    EXPECT_EQ(group.on, 2);
  }
}

Edges Without(const Edges& edges, int node) {
  Edges rest;
  for (const auto& [a, b] : edges) {
    if (a != node && b != node) rest.emplace_back(a, b);
  }
  return rest;
}

// Whichever node goes, those in no group stay together; without what it hangs on, a group is apart
// from all others.
TEST(HangingGroups, AgreesWithCuttingEveryNode) {
  std::mt19937 random(2);
  for (int trial = 0; trial < 200; ++trial) {
    const int nodes = 3 + static_cast<int>(random() % 12);
    const Edges edges = MadeEdges(nodes, random);
    std::vector<int> group_of(nodes, -1);
    const auto groups = HangingGroups(nodes, edges);
    for (size_t g = 0; g < groups.size(); ++g) {
      for (const int node : groups[g].nodes) group_of[node] = static_cast<int>(g);
      const Connectivity cut = ConnectivityOf(nodes, Without(edges, groups[g].on));
      for (int other = 0; other < nodes; ++other) {
        if (group_of[other] == static_cast<int>(g) || other == groups[g].on) continue;
        EXPECT_NE(cut.part[other], cut.part[groups[g].nodes.front()]) << trial;
      }
    }
    for (int node = 0; node < nodes; ++node) {
      const Connectivity cut = ConnectivityOf(nodes, Without(edges, node));
      std::set<int> parts;
      for (int other = 0; other < nodes; ++other) {
        if (other != node && group_of[other] < 0) parts.insert(cut.part[other]);
      }
      EXPECT_LE(parts.size(), 1u) << trial;
    }
  }
}

}  // namespace
}  // namespace stucco::plan
