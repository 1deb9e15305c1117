// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/path/tour_bound.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>

namespace stucco::plan {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr int kMostSteps = 300;
constexpr double kWorkPerBound = 4e8;  // edges looked at: fewer steps on big maps
constexpr int kPatience = 8;           // steps without progress before they are halved
constexpr int kMostRounds = 4;

struct Neighbour {
  int hover = 0;
  double cost = 0;
};
using Graph = std::vector<std::vector<Neighbour>>;
using Weights = std::vector<double>;

struct OneTree {
  double cost = 0;  // with weights, less twice their sum: a bound if the tree is least
  std::vector<int> parent;
  std::vector<int> degree;
  int leaf = 0;    // has one more edge,
  int second = 0;  // to here
};

void AddEdge(Graph& graph, int i, int j, double cost) {
  const auto has = [&](const Neighbour& n) { return n.hover == j; };
  if (std::any_of(graph[i].begin(), graph[i].end(), has)) return;
  graph[i].push_back({j, cost});
  graph[j].push_back({i, cost});
}

Graph CandidateGraph(std::span<const std::vector<Candidate>> candidates) {
  Graph graph(candidates.size());
  for (size_t i = 0; i < candidates.size(); ++i) {
    for (const Candidate& c : candidates[i]) AddEdge(graph, static_cast<int>(i), c.hover, c.cost);
  }
  return graph;
}

// Any leaf with any edge that is not the tree's gives a 1-tree; the dearest second edge of a leaf
// gives the best bound. `second` says the cheapest such edge of a leaf.
template <typename Second>
void AddSecondEdge(OneTree& tree, const Second& second) {
  double dearest = -kInfinity;
  for (size_t k = 0; k < tree.degree.size(); ++k) {
    if (tree.degree[k] != 1) continue;
    const Neighbour edge = second(static_cast<int>(k));
    if (!(edge.cost > dearest) || edge.cost == kInfinity) continue;
    dearest = edge.cost;
    tree.leaf = static_cast<int>(k);
    tree.second = edge.hover;
  }
  if (dearest == -kInfinity) return;
  tree.cost += dearest;
  ++tree.degree[tree.leaf];
  ++tree.degree[tree.second];
}

void CountDegrees(OneTree& tree) {
  tree.degree.assign(tree.parent.size(), 0);
  for (size_t k = 0; k < tree.parent.size(); ++k) {
    if (tree.parent[k] < 0) continue;
    ++tree.degree[k];
    ++tree.degree[tree.parent[k]];
  }
}

// The hover at the only tree edge of a leaf.
std::vector<int> TreeNeighbourOfLeaves(const OneTree& tree) {
  std::vector<int> neighbour = tree.parent;
  for (size_t k = 0; k < tree.parent.size(); ++k) {
    const int p = tree.parent[k];
    if (p >= 0 && tree.parent[p] < 0) neighbour[p] = static_cast<int>(k);
  }
  return neighbour;
}

// Prim's algorithm on the graph.
OneTree LeastOneTree(const Graph& graph, const Weights& weights) {
  const size_t n = graph.size();
  OneTree tree;
  tree.parent.assign(n, -1);
  Weights key(n, kInfinity);
  std::vector<char> done(n);
  using Item = std::pair<double, int>;
  std::priority_queue<Item, std::vector<Item>, std::greater<>> open;
  for (size_t root = 0; root < n; ++root) {
    if (done[root]) continue;
    if (root > 0) tree.cost = -kInfinity;  // not connected
    open.push({0, static_cast<int>(root)});
    key[root] = 0;
    while (!open.empty()) {
      const auto [cost, at] = open.top();
      open.pop();
      if (done[at]) continue;
      done[at] = 1;
      tree.cost += cost;
      for (const Neighbour& edge : graph[at]) {
        const double next = edge.cost + weights[at] + weights[edge.hover];
        if (done[edge.hover] || !(next < key[edge.hover])) continue;
        key[edge.hover] = next;
        tree.parent[edge.hover] = at;
        open.push({next, edge.hover});
      }
    }
  }
  CountDegrees(tree);
  const std::vector<int> neighbour = TreeNeighbourOfLeaves(tree);
  AddSecondEdge(tree, [&](int leaf) {
    Neighbour best{-1, kInfinity};
    for (const Neighbour& edge : graph[leaf]) {
      const double cost = edge.cost + weights[leaf] + weights[edge.hover];
      if (edge.hover != neighbour[leaf] && cost < best.cost) best = {edge.hover, cost};
    }
    return best;
  });
  for (const double weight : weights) tree.cost -= 2 * weight;
  return tree;
}

// The weights that make the least 1-tree of the graph dearest.
Weights Ascend(const Graph& graph, double tour_cost, Weights weights) {
  size_t edges = 0;
  for (const auto& neighbours : graph) edges += neighbours.size();
  const int steps =
      std::clamp(static_cast<int>(kWorkPerBound / static_cast<double>(edges)), 60, kMostSteps);
  Weights best_weights = weights;
  std::vector<double> previous(graph.size(), 0);
  double best = -kInfinity;
  double scale = 1;
  int stalled = 0;
  for (int step = 0; step < steps; ++step) {
    const OneTree tree = LeastOneTree(graph, weights);
    if (tree.cost > best) {
      if (tree.cost > best + 1e-5 * std::abs(best)) stalled = 0;
      best = tree.cost;
      best_weights = weights;
    }
    if (++stalled > kPatience) {
      stalled = 0;
      scale *= 0.5;
      weights = best_weights;
    }
    double squares = 0;
    for (const int degree : tree.degree) squares += (degree - 2) * (degree - 2);
    if (squares == 0) break;  // a tour: nothing is better
    const double length = scale * std::max(tour_cost - tree.cost, 1e-3 * tour_cost) / squares;
    for (size_t k = 0; k < weights.size(); ++k) {
      const double direction = 0.7 * (tree.degree[k] - 2) + 0.3 * previous[k];
      weights[k] += length * direction;
      previous[k] = tree.degree[k] - 2;
    }
  }
  return best_weights;
}

// All pairs of hovers with costs that are at most the true ones.
class AllPairs {
 public:
  AllPairs(const HoverCosts& costs, const Graph& graph, const Weights& weights)
      : costs_(costs), graph_(graph), weights_(weights) {}

  // Calls fn(j, cost) for hovers j of `others` whose edge to i may cost less than limit(j).
  template <typename Limit, typename Fn>
  void ForCheap(int i, std::span<const int> others, const Limit& limit, const Fn& fn) const {
    const Eigen::Vector3d at = costs_.Position(i);
    for (const int j : others) {
      const double reach = (limit(j) - weights_[i] - weights_[j]) / kLeastWeight;
      if (!(reach > 0) || (costs_.Position(j) - at).squaredNorm() >= reach * reach) continue;
      if (j != i) fn(j, Cost(i, j));
    }
  }
  double Cost(int i, int j) const {
    for (const Neighbour& edge : graph_[i]) {
      if (edge.hover == j) return edge.cost + weights_[i] + weights_[j];
    }
    return costs_.LeastCost(i, j) + weights_[i] + weights_[j];
  }

 private:
  const HoverCosts& costs_;
  const Graph& graph_;
  const Weights& weights_;
};

// Prim's algorithm over all pairs: n squared distances, few costs.
OneTree LeastOneTreeOfAll(const HoverCosts& costs, const Graph& graph, const Weights& weights) {
  const int n = costs.size();
  const AllPairs pairs(costs, graph, weights);
  OneTree tree;
  tree.parent.assign(n, -1);
  Weights key(n, kInfinity);
  std::vector<int> open(n - 1);
  for (int k = 1; k < n; ++k) open[k - 1] = k;
  for (int at = 0; !open.empty();) {
    pairs.ForCheap(
        at, open, [&](int j) { return key[j]; },
        [&](int j, double cost) {
          if (!(cost < key[j])) return;
          key[j] = cost;
          tree.parent[j] = at;
        });
    const auto least =
        std::min_element(open.begin(), open.end(), [&](int i, int j) { return key[i] < key[j]; });
    at = *least;
    tree.cost += key[at];
    *least = open.back();
    open.pop_back();
  }
  CountDegrees(tree);
  const std::vector<int> neighbour = TreeNeighbourOfLeaves(tree);
  // One leaf is enough; the one whose second edge is dearest among candidates is as good as any.
  int leaf = -1;
  double dearest = -kInfinity;
  for (int k = 0; k < n; ++k) {
    if (tree.degree[k] != 1) continue;
    double second = kInfinity;
    for (const Neighbour& edge : graph[k]) {
      if (edge.hover != neighbour[k]) {
        second = std::min(second, edge.cost + weights[k] + weights[edge.hover]);
      }
    }
    if (second < dearest && leaf >= 0) continue;
    dearest = second;
    leaf = k;
  }
  AddSecondEdge(tree, [&](int k) {
    Neighbour best{-1, kInfinity};
    if (k != leaf) return best;
    for (int j = 0; j < n; ++j) {
      if (j == k || j == neighbour[k]) continue;
      if (const double cost = pairs.Cost(k, j); cost < best.cost) best = {j, cost};
    }
    return best;
  });
  for (const double weight : weights) tree.cost -= 2 * weight;
  return tree;
}

// Adds the tree's edges to the graph, with their true costs; says whether any was new.
bool AddTreeEdges(const HoverCosts& costs, const OneTree& tree, Graph& graph) {
  size_t before = 0;
  size_t after = 0;
  for (const auto& edges : graph) before += edges.size();
  const auto add = [&](int i, int j) {
    const auto is_j = [&](const Neighbour& edge) { return edge.hover == j; };
    if (std::none_of(graph[i].begin(), graph[i].end(), is_j)) {
      AddEdge(graph, i, j, costs.CheapestCost(i, j));
    }
  };
  for (size_t k = 0; k < tree.parent.size(); ++k) {
    if (tree.parent[k] >= 0) add(static_cast<int>(k), tree.parent[k]);
  }
  add(tree.leaf, tree.second);
  for (const auto& edges : graph) after += edges.size();
  return after > before;
}

}  // namespace

double TourLowerBound(const HoverCosts& costs, std::span<const std::vector<Candidate>> candidates,
                      double tour_cost) {
  const int n = costs.size();
  if (n < 2) return 0;
  if (n == 2) return 2 * costs.CheapestCost(0, 1);
  Graph graph = CandidateGraph(candidates);
  Weights weights(n, 0);
  // A least tree over all pairs connects the graph.
  OneTree tree = LeastOneTreeOfAll(costs, graph, weights);
  double bound = tree.cost;
  AddTreeEdges(costs, tree, graph);
  for (int round = 0; round < kMostRounds; ++round) {
    weights = Ascend(graph, tour_cost, std::move(weights));
    tree = LeastOneTreeOfAll(costs, graph, weights);
    bound = std::max(bound, tree.cost);
    if (!AddTreeEdges(costs, tree, graph)) break;
  }
  // Costs are sums of rounded terms.
  return std::max(0.0, bound * (1 - 1e-12));
}

}  // namespace stucco::plan
