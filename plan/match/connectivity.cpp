// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/match/connectivity.h"

#include <algorithm>
#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/biconnected_components.hpp>
#include <boost/graph/connected_components.hpp>
#include <iterator>

namespace stucco::plan {
namespace {

using Edge = boost::property<boost::edge_index_t, size_t>;
using Graph =
    boost::adjacency_list<boost::vecS, boost::vecS, boost::undirectedS, boost::no_property, Edge>;

Graph MakeGraph(int nodes, const std::vector<std::pair<int, int>>& edges) {
  Graph graph(nodes);
  for (size_t i = 0; i < edges.size(); ++i) {
    boost::add_edge(edges[i].first, edges[i].second, Edge(i), graph);
  }
  return graph;
}

}  // namespace

// A bridge is a biconnected component of one edge; without the bridges, what hangs together are the
// blocks.
Connectivity ConnectivityOf(int nodes, const std::vector<std::pair<int, int>>& edges) {
  Connectivity out;
  const Graph graph = MakeGraph(nodes, edges);
  out.part.resize(nodes);
  out.parts = boost::connected_components(graph, out.part.data());
  std::vector<size_t> component(edges.size());
  const auto component_map =
      boost::make_iterator_property_map(component.begin(), boost::get(boost::edge_index, graph));
  const size_t components = boost::biconnected_components(graph, component_map);
  std::vector<size_t> count(components);
  for (const size_t c : component) ++count[c];
  std::vector<std::pair<int, int>> rest;
  for (size_t i = 0; i < edges.size(); ++i) {
    const auto edge = std::minmax(edges[i].first, edges[i].second);
    (count[component[i]] == 1 ? out.bridges : rest).emplace_back(edge.first, edge.second);
  }
  std::ranges::sort(out.bridges);
  out.block.resize(nodes);
  out.blocks = boost::connected_components(MakeGraph(nodes, rest), out.block.data());
  return out;
}

}  // namespace stucco::plan
