// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/path/tour_bound.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <queue>

namespace stucco::plan {
namespace {

constexpr double kUnbounded = std::numeric_limits<double>::infinity();
constexpr int kMostSteps = 600;
constexpr double kWorkPerBound = 1e8;  // edges looked at, four costs each: fewer steps on big maps
constexpr int kPatience = 8;           // steps without progress before they are halved
constexpr double kLeastScale = 1e-3;   // of a step: shorter ones change nothing
constexpr int kMostRounds = 40;
constexpr double kWorthARound = 2e-3;  // of the bound, that another round has to promise

// Costs from both ports of one hover to both of another: of port a to port b at 2 a + b.
using PortTable = std::array<double, 4>;

struct Neighbour {
  int hover = 0;
  PortTable costs{};
};
using Graph = std::vector<std::vector<Neighbour>>;
using Weights = std::vector<double>;  // by port

// An edge between two hovers with its cheapest ports, weights included.
struct Edge {
  int hover = -1;  // the other end
  double cost = kUnbounded;
  Port from = 0;
  Port to = 0;
};

Edge Cheapest(int i, const Neighbour& neighbour, const Weights& weights) {
  Edge best;
  for (int a = 0; a < 2; ++a) {
    for (int b = 0; b < 2; ++b) {
      const Port from = 2 * i + a;
      const Port to = 2 * neighbour.hover + b;
      const double cost = neighbour.costs[2 * a + b] + weights[from] + weights[to];
      if (cost < best.cost) best = {neighbour.hover, cost, from, to};
    }
  }
  return best;
}

struct OneTree {
  // With weights, less their sum: a bound if the tree is least.
  double cost = 0;
  std::vector<Edge> parent;     // by hover; hover -1 at the root
  std::vector<int> degree;      // by hover
  std::vector<int> port_edges;  // by port
  int leaf = 0;                 // has one more edge,
  Edge second;                  // this
};

void AddEdge(Graph& graph, int i, int j, const PortTable& costs) {
  const auto has = [&](const Neighbour& n) { return n.hover == j; };
  if (std::any_of(graph[i].begin(), graph[i].end(), has)) return;
  graph[i].push_back({j, costs});
  graph[j].push_back({i, {costs[0], costs[2], costs[1], costs[3]}});
}

PortTable TableOf(const HoverCosts& costs, int i, int j, double length_m) {
  PortTable table{};
  const double weight = costs.Weight(i, j);
  for (int a = 0; a < 2; ++a) {
    for (int b = 0; b < 2; ++b) {
      table[2 * a + b] = HoverCosts::Cost(weight, length_m, costs.Turn(2 * i + a, 2 * j + b));
    }
  }
  return table;
}

Graph CandidateGraph(const HoverCosts& costs,
                     std::span<const std::vector<TourCandidate>> candidates) {
  Graph graph(candidates.size());
  for (size_t k = 0; k < candidates.size(); ++k) {
    const int i = static_cast<int>(k);
    for (const TourCandidate& c : candidates[k]) {
      AddEdge(graph, i, c.hover, TableOf(costs, i, c.hover, c.length_m));
    }
  }
  return graph;
}

void Count(int hover, const Edge& edge, OneTree& tree) {
  ++tree.degree[hover];
  ++tree.degree[edge.hover];
  ++tree.port_edges[edge.from];
  ++tree.port_edges[edge.to];
}

void CountDegrees(OneTree& tree) {
  tree.degree.assign(tree.parent.size(), 0);
  tree.port_edges.assign(2 * tree.parent.size(), 0);
  for (size_t k = 0; k < tree.parent.size(); ++k) {
    if (tree.parent[k].hover >= 0) Count(static_cast<int>(k), tree.parent[k], tree);
  }
}

// Any leaf with any edge that is not the tree's gives a 1-tree; the dearest second edge of a leaf
// gives the best bound. `second` says the cheapest such edge of a leaf.
template <typename Second>
void AddSecondEdge(OneTree& tree, const Second& second) {
  double dearest = -kUnbounded;
  for (size_t k = 0; k < tree.degree.size(); ++k) {
    if (tree.degree[k] != 1) continue;
    const Edge edge = second(static_cast<int>(k));
    if (!(edge.cost > dearest) || edge.cost == kUnbounded) continue;
    dearest = edge.cost;
    tree.leaf = static_cast<int>(k);
    tree.second = edge;
  }
  if (dearest == -kUnbounded) return;
  tree.cost += dearest;
  Count(tree.leaf, tree.second, tree);
}

// The hover at the only tree edge of a leaf.
std::vector<int> TreeNeighbourOfLeaves(const OneTree& tree) {
  std::vector<int> neighbour(tree.parent.size(), -1);
  for (size_t k = 0; k < tree.parent.size(); ++k) {
    const int p = tree.parent[k].hover;
    if (p < 0) continue;
    neighbour[k] = p;
    if (tree.parent[p].hover < 0) neighbour[p] = static_cast<int>(k);
  }
  return neighbour;
}

// Prim's algorithm on the graph.
OneTree LeastTree(const Graph& graph, const Weights& weights) {
  const size_t n = graph.size();
  OneTree tree;
  tree.parent.assign(n, {});
  std::vector<double> key(n, kUnbounded);
  std::vector<char> done(n);
  using Item = std::pair<double, int>;
  std::priority_queue<Item, std::vector<Item>, std::greater<>> open;
  for (size_t root = 0; root < n; ++root) {
    if (done[root]) continue;
    if (root > 0) tree.cost = -kUnbounded;  // not connected
    open.push({0, static_cast<int>(root)});
    key[root] = 0;
    while (!open.empty()) {
      const auto [cost, at] = open.top();
      open.pop();
      if (done[at]) continue;
      done[at] = 1;
      tree.cost += cost;
      for (const Neighbour& neighbour : graph[at]) {
        if (done[neighbour.hover]) continue;
        const Edge edge = Cheapest(at, neighbour, weights);
        if (!(edge.cost < key[edge.hover])) continue;
        key[edge.hover] = edge.cost;
        tree.parent[edge.hover] = {at, edge.cost, edge.to, edge.from};
        open.push({edge.cost, edge.hover});
      }
    }
  }
  CountDegrees(tree);
  return tree;
}

OneTree LeastOneTree(const Graph& graph, const Weights& weights) {
  OneTree tree = LeastTree(graph, weights);
  const std::vector<int> neighbour = TreeNeighbourOfLeaves(tree);
  AddSecondEdge(tree, [&](int leaf) {
    Edge best;
    for (const Neighbour& other : graph[leaf]) {
      if (other.hover == neighbour[leaf]) continue;
      const Edge edge = Cheapest(leaf, other, weights);
      if (edge.cost < best.cost) best = edge;
    }
    return best;
  });
  for (const double weight : weights) tree.cost -= weight;
  return tree;
}

// Weights are raised hover by hover first, which soon comes near the best, then port by port.
enum class By { kHover, kPort };

// How many edges too many a hover, or a port, has.
double Excess(const OneTree& tree, size_t port, By by) {
  return by == By::kHover ? tree.degree[port / 2] - 2 : tree.port_edges[port] - 1;
}

// How long the first steps are. Weights that were good before an edge or two came need small ones.
double FirstScale(By by, bool is_first_round) {
  const double scale = by == By::kHover ? 1 : 0.25;
  return is_first_round ? scale : scale / 32;
}

// The weights that make the least 1-tree of the graph dearest.
Weights Ascend(const Graph& graph, double tour_cost, Weights weights, By by, double scale) {
  size_t edges = 0;
  for (const auto& neighbours : graph) edges += neighbours.size();
  const int steps =
      std::clamp(static_cast<int>(kWorkPerBound / static_cast<double>(edges)), 60, kMostSteps);
  Weights best_weights = weights;
  std::vector<double> previous(weights.size(), 0);
  double best = -kUnbounded;
  int stalled = 0;
  for (int step = 0; step < steps && scale > kLeastScale; ++step) {
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
    for (size_t k = 0; k < weights.size(); ++k) squares += std::pow(Excess(tree, k, by), 2);
    if (squares == 0) break;             // nothing to learn from it
    if (by == By::kHover) squares /= 2;  // both ports of a hover count the same
    const double length = scale * std::max(tour_cost - tree.cost, 1e-3 * tour_cost) / squares;
    for (size_t k = 0; k < weights.size(); ++k) {
      const double excess = Excess(tree, k, by);
      weights[k] += length * (0.7 * excess + 0.3 * previous[k]);
      previous[k] = excess;
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
      const double reach = (limit(j) - Lighter(i) - Lighter(j)) / kLeastWeight;
      if (!(reach > 0) || (costs_.Position(j) - at).squaredNorm() >= reach * reach) continue;
      if (j != i) fn(j, Between(i, j));
    }
  }
  Edge Between(int i, int j) const {
    for (const Neighbour& neighbour : graph_[i]) {
      if (neighbour.hover == j) return Cheapest(i, neighbour, weights_);
    }
    return {j, costs_.LeastCost(i, j) + Lighter(i) + Lighter(j), LighterPort(i), LighterPort(j)};
  }

 private:
  Port LighterPort(int i) const {
    return weights_[2 * i + 1] < weights_[2 * i] ? 2 * i + 1 : 2 * i;
  }
  double Lighter(int i) const { return weights_[LighterPort(i)]; }

  const HoverCosts& costs_;
  const Graph& graph_;
  const Weights& weights_;
};

// Prim's algorithm over all pairs: n squared distances, few costs.
OneTree LeastTreeOfAll(int n, const AllPairs& pairs) {
  OneTree tree;
  tree.parent.assign(n, {});
  std::vector<double> key(n, kUnbounded);
  std::vector<int> open(n - 1);
  for (int k = 1; k < n; ++k) open[k - 1] = k;
  for (int at = 0; !open.empty();) {
    pairs.ForCheap(
        at, open, [&](int j) { return key[j]; },
        [&](int j, const Edge& edge) {
          if (!(edge.cost < key[j])) return;
          key[j] = edge.cost;
          tree.parent[j] = {at, edge.cost, edge.to, edge.from};
        });
    const auto least =
        std::min_element(open.begin(), open.end(), [&](int i, int j) { return key[i] < key[j]; });
    at = *least;
    tree.cost += key[at];
    *least = open.back();
    open.pop_back();
  }
  CountDegrees(tree);
  return tree;
}

// The leaf whose second edge is dearest among candidates.
int DearestLeaf(const OneTree& tree, std::span<const int> neighbour, const Graph& graph,
                const Weights& weights) {
  const int n = static_cast<int>(graph.size());
  int leaf = -1;
  double dearest = -kUnbounded;
  for (int k = 0; k < n; ++k) {
    if (tree.degree[k] != 1) continue;
    double second = kUnbounded;
    for (const Neighbour& other : graph[k]) {
      if (other.hover != neighbour[k]) {
        second = std::min(second, Cheapest(k, other, weights).cost);
      }
    }
    if (second < dearest && leaf >= 0) continue;
    dearest = second;
    leaf = k;
  }
  return leaf;
}

// One leaf is enough, and the one whose second edge is dearest among candidates as good as any.
OneTree LeastOneTreeOfAll(const HoverCosts& costs, const Graph& graph, const Weights& weights) {
  const int n = costs.size();
  const AllPairs pairs(costs, graph, weights);
  OneTree tree = LeastTreeOfAll(n, pairs);
  const std::vector<int> neighbour = TreeNeighbourOfLeaves(tree);
  const int leaf = DearestLeaf(tree, neighbour, graph, weights);
  AddSecondEdge(tree, [&](int k) {
    Edge best;
    if (k != leaf) return best;
    for (int j = 0; j < n; ++j) {
      if (j == k || j == neighbour[k]) continue;
      if (const Edge edge = pairs.Between(k, j); edge.cost < best.cost) best = edge;
    }
    return best;
  });
  for (const double weight : weights) tree.cost -= weight;
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
      AddEdge(graph, i, j, TableOf(costs, i, j, costs.Length(i, j)));
    }
  };
  for (size_t k = 0; k < tree.parent.size(); ++k) {
    if (tree.parent[k].hover >= 0) add(static_cast<int>(k), tree.parent[k].hover);
  }
  if (tree.second.hover >= 0) add(tree.leaf, tree.second.hover);
  for (const auto& edges : graph) after += edges.size();
  return after > before;
}

}  // namespace

double TourLowerBound(const HoverCosts& costs,
                      std::span<const std::vector<TourCandidate>> candidates, double tour_cost) {
  const int n = costs.size();
  if (n < 2) return 0;
  if (n == 2) return 2 * costs.CheapestCost(0, 1);
  Graph graph = CandidateGraph(costs, candidates);
  Weights weights(2 * static_cast<size_t>(n), 0);
  // A least tree over all pairs connects the graph.
  OneTree tree = LeastOneTreeOfAll(costs, graph, weights);
  double bound = tree.cost;
  AddTreeEdges(costs, tree, graph);
  for (int round = 0; round < kMostRounds; ++round) {
    for (const By by : {By::kHover, By::kPort}) {
      weights = Ascend(graph, tour_cost, std::move(weights), by, FirstScale(by, round == 0));
    }
    tree = LeastOneTreeOfAll(costs, graph, weights);
    bound = std::max(bound, tree.cost);
    // With all pairs priced the bound can come up to that of the graph, no farther.
    const double most = LeastOneTree(graph, weights).cost;
    if (!AddTreeEdges(costs, tree, graph) || tree.cost >= most - kWorthARound * most) break;
  }
  // Costs are sums of rounded terms.
  return std::max(0.0, bound * (1 - 1e-12));
}

}  // namespace stucco::plan
