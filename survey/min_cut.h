// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace stucco {

// Capacities are whole numbers of at least 0: sums of flows are exact, so the search always ends.
struct FlowNode {
  int64_t from_source = 0;
  int64_t to_sink = 0;
};

struct FlowEdge {
  size_t a = 0;  // indices of nodes
  size_t b = 0;
  int64_t there = 0;  // from a to b
  int64_t back = 0;
};

// The nodes on the source's side of a minimum cut (Boykov, Kolmogorov, "An experimental comparison
// of min-cut/max-flow algorithms", 2004); where there are several, of the one with the fewest.
std::vector<bool> SourceSide(std::span<const FlowNode> nodes, std::span<const FlowEdge> edges);

}  // namespace stucco
