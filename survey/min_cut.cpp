// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/min_cut.h"

#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/boykov_kolmogorov_max_flow.hpp>

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

void Connect(Graph& graph, const FlowEdge& edge) {
  if (edge.there == 0 && edge.back == 0) return;
  const auto there = boost::add_edge(edge.a, edge.b, graph).first;
  const auto back = boost::add_edge(edge.b, edge.a, graph).first;
  boost::put(boost::edge_capacity, graph, there, edge.there);
  boost::put(boost::edge_capacity, graph, back, edge.back);
  boost::put(boost::edge_reverse, graph, there, back);
  boost::put(boost::edge_reverse, graph, back, there);
}

}  // namespace

std::vector<bool> SourceSide(std::span<const FlowNode> nodes, std::span<const FlowEdge> edges) {
  Graph graph(nodes.size() + 2);
  const size_t source = nodes.size(), sink = nodes.size() + 1;
  for (size_t i = 0; i < nodes.size(); ++i) {
    Connect(graph, {source, i, nodes[i].from_source, 0});
    Connect(graph, {i, sink, nodes[i].to_sink, 0});
  }
  for (const FlowEdge& edge : edges) Connect(graph, edge);
  boost::boykov_kolmogorov_max_flow(graph, source, sink);
  std::vector<bool> side(nodes.size());
  for (size_t i = 0; i < nodes.size(); ++i) {
    side[i] = boost::get(boost::vertex_color, graph, i) == boost::black_color;
  }
  return side;
}

}  // namespace stucco
