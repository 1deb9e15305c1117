// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/match/connectivity.h"

#include <algorithm>
#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/biconnected_components.hpp>
#include <boost/graph/connected_components.hpp>
#include <iterator>
#include <set>

namespace stucco::plan {
namespace {

using Graph =
    boost::adjacency_list<boost::vecS, boost::vecS, boost::undirectedS, boost::no_property,
                          boost::property<boost::edge_index_t, size_t>>;

Graph MakeGraph(int nodes, const Edges& edges) {
  Graph graph(nodes);
  for (size_t i = 0; i < edges.size(); ++i) {
    boost::add_edge(edges[i].first, edges[i].second, i, graph);
  }
  return graph;
}

// The biconnected components of a graph.
struct Components {
  std::vector<size_t> of_edge;
  size_t count = 0;
};

Components ComponentsOf(const Graph& graph, size_t edges) {
  Components out{.of_edge = std::vector<size_t>(edges), .count = 0};
  out.count = boost::biconnected_components(
      graph,
      boost::make_iterator_property_map(out.of_edge.begin(), boost::get(boost::edge_index, graph)));
  return out;
}

// By node, whether it is in the component that has the most; without edges, in none.
std::vector<bool> InLargest(int nodes, const Edges& edges) {
  const Components components = ComponentsOf(MakeGraph(nodes, edges), edges.size());
  std::vector<std::set<int>> members(components.count);
  for (size_t i = 0; i < edges.size(); ++i) {
    members[components.of_edge[i]].insert({edges[i].first, edges[i].second});
  }
  std::vector<bool> out(nodes, false);
  const auto largest = std::ranges::max_element(members, {}, &std::set<int>::size);
  if (largest == members.end()) return out;
  for (const int node : *largest) out[node] = true;
  return out;
}

}  // namespace

// A bridge is a biconnected component of one edge.
Connectivity ConnectivityOf(int nodes, const Edges& edges) {
  Connectivity out;
  const Graph graph = MakeGraph(nodes, edges);
  out.part.resize(nodes);
  out.parts = boost::connected_components(graph, out.part.data());
  const Components components = ComponentsOf(graph, edges.size());
  std::vector<size_t> count(components.count);
  for (const size_t c : components.of_edge) ++count[c];
  for (size_t i = 0; i < edges.size(); ++i) {
    if (count[components.of_edge[i]] > 1) continue;
    out.bridges.push_back(std::minmax(edges[i].first, edges[i].second));
  }
  std::ranges::sort(out.bridges);
  return out;
}

// Without the nodes of the largest component, what hangs together does so apart from it; of these
// nodes it can touch one only, or it would be in the component.
std::vector<HangingGroup> HangingGroups(int nodes, const Edges& edges) {
  const std::vector<bool> inside = InLargest(nodes, edges);
  Edges rest;
  for (const auto& [a, b] : edges) {
    if (!inside[a] && !inside[b]) rest.emplace_back(a, b);
  }
  const Connectivity apart = ConnectivityOf(nodes, rest);
  std::vector<HangingGroup> groups(apart.parts);
  for (int node = 0; node < nodes; ++node) {
    if (!inside[node]) groups[apart.part[node]].nodes.push_back(node);
  }
  for (const auto& [a, b] : edges) {
    if (inside[a] != inside[b]) groups[apart.part[inside[a] ? b : a]].on = inside[a] ? a : b;
  }
  std::erase_if(groups, [](const HangingGroup& group) { return group.nodes.empty(); });
  return groups;
}

}  // namespace stucco::plan
