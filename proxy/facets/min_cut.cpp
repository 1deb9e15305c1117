// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/facets/min_cut.h"

#include <cmath>

#include "survey/min_cut.h"

namespace stucco {

std::vector<bool> CheapestLabels(std::span<const CutNode> nodes, std::span<const CutLink> links) {
  double total = 0;
  for (const CutNode& node : nodes) total += node.cost_in + node.cost_out;
  for (const CutLink& link : links) total += 2 * link.cost;
  if (!(total > 0)) return std::vector<bool>(nodes.size(), false);
  const double scale = std::ldexp(1.0, 50) / total;
  const auto whole = [&](double cost) { return static_cast<int64_t>(std::llround(cost * scale)); };
  std::vector<FlowNode> flow_nodes;
  for (const CutNode& node : nodes) {
    flow_nodes.push_back({whole(node.cost_out), whole(node.cost_in)});
  }
  std::vector<FlowEdge> edges;
  for (const CutLink& link : links) {
    const int64_t cost = whole(link.cost);
    edges.push_back({static_cast<size_t>(link.a), static_cast<size_t>(link.b), cost, cost});
  }
  return SourceSide(flow_nodes, edges);
}

}  // namespace stucco
