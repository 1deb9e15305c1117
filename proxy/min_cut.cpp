// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/min_cut.h"

#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/boykov_kolmogorov_max_flow.hpp>
#include <cmath>
#include <cstdint>

namespace stucco {
namespace {

using Traits = boost::adjacency_list_traits<boost::vecS, boost::vecS, boost::directedS>;
using VertexProperties = boost::property<
    boost::vertex_color_t, boost::default_color_type,
    boost::property<boost::vertex_distance_t, int64_t,
                    boost::property<boost::vertex_predecessor_t, Traits::edge_descriptor>>>;
using EdgeProperties = boost::property<
    boost::edge_capacity_t, int64_t,
    boost::property<boost::edge_residual_capacity_t, int64_t,
                    boost::property<boost::edge_reverse_t, Traits::edge_descriptor>>>;
using Graph = boost::adjacency_list<boost::vecS, boost::vecS, boost::directedS, VertexProperties,
                                    EdgeProperties>;

void Connect(Graph& graph, size_t a, size_t b, int64_t forward, int64_t backward) {
  if (forward == 0 && backward == 0) return;
  const auto there = boost::add_edge(a, b, graph).first;
  const auto back = boost::add_edge(b, a, graph).first;
  boost::put(boost::edge_capacity, graph, there, forward);
  boost::put(boost::edge_capacity, graph, back, backward);
  boost::put(boost::edge_reverse, graph, there, back);
  boost::put(boost::edge_reverse, graph, back, there);
}

}  // namespace

std::vector<bool> CheapestLabels(std::span<const CutNode> nodes, std::span<const CutLink> links) {
  double total = 0;
  for (const CutNode& node : nodes) total += node.cost_in + node.cost_out;
  for (const CutLink& link : links) total += 2 * link.cost;
  if (!(total > 0)) return std::vector<bool>(nodes.size(), false);
  // Whole numbers: sums of flows are exact, so the search always ends.
  const double scale = std::ldexp(1.0, 50) / total;
  const auto whole = [&](double cost) { return static_cast<int64_t>(std::llround(cost * scale)); };
  Graph graph(nodes.size() + 2);
  const size_t in = nodes.size(), out = nodes.size() + 1;
  for (size_t i = 0; i < nodes.size(); ++i) {
    Connect(graph, in, i, whole(nodes[i].cost_out), 0);
    Connect(graph, i, out, whole(nodes[i].cost_in), 0);
  }
  for (const CutLink& link : links) {
    Connect(graph, static_cast<size_t>(link.a), static_cast<size_t>(link.b), whole(link.cost),
            whole(link.cost));
  }
  boost::boykov_kolmogorov_max_flow(graph, in, out);
  std::vector<bool> labels(nodes.size());
  for (size_t i = 0; i < nodes.size(); ++i) {
    labels[i] = boost::get(boost::vertex_color, graph, i) == boost::black_color;
  }
  return labels;
}

}  // namespace stucco
