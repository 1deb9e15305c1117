// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/selection/label_cut.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "survey/min_cut.h"

namespace stucco {
namespace {

constexpr int kMaxRounds = 6;
constexpr double kCapacityUnit = 1e-5;  // flows are whole numbers of this: exact arithmetic

// Minimises a submodular function of binary variables. 0 is the source's side.
class BinaryCut {
 public:
  explicit BinaryCut(size_t variables) : cost_(variables) {}

  size_t AddVariable() {
    cost_.push_back({});
    return cost_.size() - 1;
  }
  void AddCost(size_t variable, double if_zero, double if_one) {
    cost_[variable].zero += if_zero;
    cost_[variable].one += if_one;
  }
  // Cost of p = 0 and q = 1.
  void AddPair(size_t p, size_t q, double cost) {
    if (cost > 0) pairs_.push_back({p, q, cost});
  }
  std::vector<uint8_t> Solve() const;

 private:
  struct Unary {
    double zero = 0;
    double one = 0;
  };
  struct Pair {
    size_t p;
    size_t q;
    double cost;
  };
  std::vector<Unary> cost_;
  std::vector<Pair> pairs_;
};

std::vector<uint8_t> BinaryCut::Solve() const {
  const auto whole = [](double cost) {
    return static_cast<int64_t>(std::llround(cost / kCapacityUnit));
  };
  std::vector<FlowNode> nodes;
  for (const Unary& cost : cost_) {
    const double common = std::min(cost.zero, cost.one);
    nodes.push_back({whole(cost.one - common), whole(cost.zero - common)});
  }
  std::vector<FlowEdge> edges;
  for (const Pair& pair : pairs_) edges.push_back({pair.p, pair.q, whole(pair.cost), 0});
  std::vector<uint8_t> one;
  for (const bool is_zero : SourceSide(nodes, edges)) one.push_back(is_zero ? 0 : 1);
  return one;
}

std::vector<size_t> UseOfLabels(const LabelProblem& problem, const Labels& labels) {
  std::vector<size_t> use(problem.labels, 0);
  for (int label : labels) {
    if (label >= 0) ++use[label];
  }
  return use;
}

// Calls fn(cell, neighbour, direction) for all neighbours with labels.
template <typename Fn>
void ForEachEdge(const LabelProblem& problem, const Labels& labels, Fn&& fn) {
  for (int y = 0; y < problem.height; ++y) {
    for (int x = 0; x < problem.width; ++x) {
      const size_t cell = static_cast<size_t>(y) * problem.width + x;
      if (labels[cell] < 0) continue;
      if (x + 1 < problem.width && labels[cell + 1] >= 0) fn(cell, cell + 1, 0);
      if (y + 1 < problem.height && labels[cell + problem.width] >= 0) {
        fn(cell, cell + problem.width, 1);
      }
    }
  }
}

constexpr size_t kFixed = static_cast<size_t>(-1);

void AddSeams(const LabelProblem& problem, const Labels& labels, int alpha,
              const std::vector<size_t>& variable, BinaryCut& cut) {
  ForEachEdge(problem, labels, [&](size_t p, size_t q, int direction) {
    const auto seam = [&](int a, int b) { return problem.Seam(p, direction, a, b); };
    const double both_keep = seam(labels[p], labels[q]);
    const double q_takes = seam(labels[p], alpha);
    const double p_takes = seam(alpha, labels[q]);
    const size_t vp = variable[p];
    const size_t vq = variable[q];
    if (vp != kFixed && vq != kFixed) {
      // Kolmogorov & Zabih 2004; pairs that break the triangle inequality are cut off at zero.
      cut.AddCost(vp, 0, p_takes - both_keep);
      cut.AddCost(vq, 0, -p_takes);
      cut.AddPair(vp, vq, q_takes + p_takes - both_keep);
    } else if (vp != kFixed) {
      cut.AddCost(vp, both_keep, p_takes);
    } else if (vq != kFixed) {
      cut.AddCost(vq, both_keep, q_takes);
    }
  });
}

// Saves a label's cost when all its cells take alpha.
void AddLabelCosts(const LabelProblem& problem, const Labels& labels, int alpha,
                   const std::vector<size_t>& variable, BinaryCut& cut) {
  if (!(problem.label_cost > 0)) return;
  std::vector<std::vector<size_t>> members(problem.labels);
  std::vector<bool> stays(problem.labels, false);
  for (size_t cell = 0; cell < labels.size(); ++cell) {
    if (labels[cell] < 0 || labels[cell] == alpha) continue;
    if (variable[cell] == kFixed) {
      stays[labels[cell]] = true;
    } else {
      members[labels[cell]].push_back(variable[cell]);
    }
  }
  for (int label = 0; label < problem.labels; ++label) {
    if (stays[label] || members[label].empty()) continue;
    const size_t in_use = cut.AddVariable();
    cut.AddCost(in_use, problem.label_cost, 0);
    for (size_t member : members[label]) cut.AddPair(member, in_use, problem.label_cost);
  }
}

Labels Expanded(const LabelProblem& problem, const Labels& labels, int alpha) {
  std::vector<size_t> variable(labels.size(), kFixed);
  std::vector<size_t> cells;
  for (size_t cell = 0; cell < labels.size(); ++cell) {
    if (labels[cell] < 0 || labels[cell] == alpha) continue;
    if (problem.Data(cell, alpha) >= LabelProblem::kForbidden) continue;
    variable[cell] = cells.size();
    cells.push_back(cell);
  }
  Labels out = labels;
  if (cells.empty()) return out;
  BinaryCut cut(cells.size());
  for (size_t i = 0; i < cells.size(); ++i) {
    cut.AddCost(i, problem.Data(cells[i], labels[cells[i]]), problem.Data(cells[i], alpha));
  }
  AddSeams(problem, labels, alpha, variable, cut);
  AddLabelCosts(problem, labels, alpha, variable, cut);
  const std::vector<uint8_t> takes = cut.Solve();
  for (size_t i = 0; i < cells.size(); ++i) {
    if (takes[i]) out[cells[i]] = alpha;
  }
  return out;
}

// Every cell takes the best of a few labels, which are added as long as one pays its cost.
Labels GreedyStart(const LabelProblem& problem) {
  std::vector<float> best(problem.cells(), LabelProblem::kForbidden);
  Labels labels(problem.cells(), -1);
  while (true) {
    int winner = -1;
    double winner_gain = problem.label_cost;
    for (int label = 0; label < problem.labels; ++label) {
      double gain = 0;
      for (size_t cell = 0; cell < best.size(); ++cell) {
        gain += std::max(0.0f, best[cell] - problem.Data(cell, label));
      }
      if (gain > winner_gain) {
        winner_gain = gain;
        winner = label;
      }
    }
    if (winner < 0) return labels;
    for (size_t cell = 0; cell < best.size(); ++cell) {
      if (problem.Data(cell, winner) < best[cell]) {
        best[cell] = problem.Data(cell, winner);
        labels[cell] = winner;
      }
    }
  }
}

// The labelling without `dropped`, its cells going to the best other labels in use; unchanged where
// a cell has no other.
Labels Without(const LabelProblem& problem, const Labels& labels, int dropped) {
  const std::vector<size_t> use = UseOfLabels(problem, labels);
  Labels out = labels;
  for (size_t cell = 0; cell < labels.size(); ++cell) {
    if (labels[cell] != dropped) continue;
    int best = -1;
    for (int label = 0; label < problem.labels; ++label) {
      if (label == dropped || use[label] == 0) continue;
      if (problem.Data(cell, label) >= LabelProblem::kForbidden) continue;
      if (best < 0 || problem.Data(cell, label) < problem.Data(cell, best)) best = label;
    }
    if (best < 0) return labels;
    out[cell] = best;
  }
  return out;
}

}  // namespace

double LabelEnergy(const LabelProblem& problem, const Labels& labels) {
  double energy = 0;
  for (size_t cell = 0; cell < labels.size(); ++cell) {
    if (labels[cell] >= 0) energy += problem.Data(cell, labels[cell]);
  }
  ForEachEdge(problem, labels, [&](size_t p, size_t q, int direction) {
    energy += problem.Seam(p, direction, labels[p], labels[q]);
  });
  for (size_t use : UseOfLabels(problem, labels)) energy += use > 0 ? problem.label_cost : 0;
  return energy;
}

Labels CutLabels(const LabelProblem& problem) {
  Labels labels = GreedyStart(problem);
  double energy = LabelEnergy(problem, labels);
  const auto try_labels = [&](Labels proposal) {
    const double proposed = LabelEnergy(problem, proposal);
    if (!(proposed < energy - kCapacityUnit * static_cast<double>(labels.size()))) return false;
    labels = std::move(proposal);
    energy = proposed;
    return true;
  };
  bool improved = true;
  for (int round = 0; improved && round < kMaxRounds; ++round) {
    improved = false;
    for (int label = 0; label < problem.labels; ++label) {
      improved |= try_labels(Expanded(problem, labels, label));
    }
    for (int label = 0; label < problem.labels; ++label) {
      if (UseOfLabels(problem, labels)[label] > 0) {
        improved |= try_labels(Without(problem, labels, label));
      }
    }
  }
  return labels;
}

}  // namespace stucco
