// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <utility>
#include <vector>

namespace stucco::plan {

using Edges = std::vector<std::pair<int, int>>;  // of nodes (a, b); each pair at most once

// How an undirected graph hangs together.
struct Connectivity {
  std::vector<int> part;  // by node, from 0
  int parts = 0;
  Edges bridges;  // (a, b), a < b: without one of them there would be one part more
};

Connectivity ConnectivityOf(int nodes, const Edges& edges);

// Nodes, ascending, that one other holds to the rest of the graph, or none.
struct HangingGroup {
  std::vector<int> nodes;
  int on = -1;  // -1: a part of its own
};

// What hangs on the largest set of nodes of which any may go without the others falling apart (a
// biconnected component).
std::vector<HangingGroup> HangingGroups(int nodes, const Edges& edges);

}  // namespace stucco::plan
