// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/path/greedy.h"

#include <algorithm>
#include <array>

#include "survey/disjoint_sets.h"

namespace stucco::plan {
namespace {

using Links = std::vector<std::array<int, 2>>;  // neighbours on the path, -1: none

Links GreedyPaths(std::span<const std::vector<TourCandidate>> candidates) {
  struct Edge {
    double cost;
    int a;
    int b;
  };
  std::vector<Edge> edges;
  for (size_t i = 0; i < candidates.size(); ++i) {
    for (const TourCandidate& candidate : candidates[i]) {
      const int a = static_cast<int>(i);
      edges.push_back({candidate.cost, std::min(a, candidate.hover), std::max(a, candidate.hover)});
    }
  }
  std::sort(edges.begin(), edges.end(), [](const Edge& e, const Edge& f) {
    return std::tie(e.cost, e.a, e.b) < std::tie(f.cost, f.a, f.b);
  });
  Links links(candidates.size(), {-1, -1});
  DisjointSets paths(candidates.size());
  for (const Edge& edge : edges) {
    if (links[edge.a][1] >= 0 || links[edge.b][1] >= 0) continue;
    if (!paths.Join(edge.a, edge.b)) continue;
    links[edge.a][links[edge.a][0] >= 0 ? 1 : 0] = edge.b;
    links[edge.b][links[edge.b][0] >= 0 ? 1 : 0] = edge.a;
  }
  return links;
}

}  // namespace

std::vector<int> GreedyTour(const HoverCosts& costs,
                            std::span<const std::vector<TourCandidate>> candidates) {
  const Links links = GreedyPaths(candidates);
  std::vector<int> ends;  // of paths not taken yet
  for (int k = 0; k < costs.size(); ++k) {
    if (links[k][1] < 0) ends.push_back(k);
  }
  std::vector<char> taken(links.size());
  std::vector<int> tour;
  while (!ends.empty()) {
    size_t nearest = 0;
    for (size_t k = 1; k < ends.size() && !tour.empty(); ++k) {
      if (costs.Straight(tour.back(), ends[k]) < costs.Straight(tour.back(), ends[nearest])) {
        nearest = k;
      }
    }
    int from = -1;
    for (int at = ends[nearest]; at >= 0;) {
      tour.push_back(at);
      taken[at] = 1;
      const int next = links[at][0] == from ? links[at][1] : links[at][0];
      from = at;
      at = next;
    }
    std::erase_if(ends, [&](int k) { return taken[k] != 0; });
  }
  return tour;
}

}  // namespace stucco::plan
