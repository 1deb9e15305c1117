// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <utility>
#include <vector>

namespace stucco::plan {

// How an undirected graph hangs together.
struct Connectivity {
  std::vector<int> part;  // by node, from 0
  int parts = 0;
  std::vector<int> block;  // by node: nodes of one block stay together whichever edge is cut
  int blocks = 0;
  std::vector<std::pair<int, int>> bridges;  // edges (a, b), a < b, that hold two blocks together
};

// Edges (a, b) of nodes below `nodes`; each pair at most once.
Connectivity ConnectivityOf(int nodes, const std::vector<std::pair<int, int>>& edges);

}  // namespace stucco::plan
