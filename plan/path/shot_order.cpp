// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/path/shot_order.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace stucco::plan {
namespace {

using Angles = std::vector<std::vector<double>>;

// Beyond this the table of subsets costs more than it gains.
constexpr int kMostExact = 9;

double Angle(const Shot& a, const Shot& b) {
  return std::acos(std::clamp(a.Direction().dot(b.Direction()), -1.0, 1.0));
}

// By set of shots, a bit each, and the last of them: the shortest path through the set, and the
// shot before the last on it.
struct Paths {
  std::vector<double> cost;
  std::vector<int> before;
};

void ExtendPaths(const Angles& angles, int set, int last, Paths& paths) {
  const int n = static_cast<int>(angles.size());
  const double cost = paths.cost[set * n + last];
  if (!(cost < std::numeric_limits<double>::infinity())) return;
  for (int next = 0; next < n; ++next) {
    if ((set >> next) & 1) continue;
    const int to = (set | (1 << next)) * n + next;
    const double through = cost + angles[last][next];
    if (!(through < paths.cost[to])) continue;
    paths.cost[to] = through;
    paths.before[to] = last;
  }
}

// Shortest path through all by subsets (Held and Karp, "A dynamic programming approach to
// sequencing problems", 1962).
std::vector<int> BestOrder(const Angles& angles) {
  const int n = static_cast<int>(angles.size());
  const int sets = 1 << n;
  const size_t states = static_cast<size_t>(sets) * n;
  Paths paths{std::vector<double>(states, std::numeric_limits<double>::infinity()),
              std::vector<int>(states, -1)};
  for (int k = 0; k < n; ++k) paths.cost[(1 << k) * n + k] = 0;
  for (int set = 1; set < sets; ++set) {
    for (int last = 0; last < n; ++last) ExtendPaths(angles, set, last, paths);
  }
  int set = sets - 1;
  int last = 0;
  for (int k = 1; k < n; ++k) {
    if (paths.cost[set * n + k] < paths.cost[set * n + last]) last = k;
  }
  std::vector<int> order;
  while (last >= 0) {
    order.push_back(last);
    const int previous = paths.before[set * n + last];
    set &= ~(1 << last);
    last = previous;
  }
  return {order.rbegin(), order.rend()};
}

// The nearest next, then reversals while they shorten the path.
std::vector<int> GoodOrder(const Angles& angles) {
  const int n = static_cast<int>(angles.size());
  std::vector<int> order{0};
  std::vector<bool> used(n);
  used[0] = true;
  while (static_cast<int>(order.size()) < n) {
    int best = -1;
    for (int k = 0; k < n; ++k) {
      if (!used[k] && (best < 0 || angles[order.back()][k] < angles[order.back()][best])) best = k;
    }
    used[best] = true;
    order.push_back(best);
  }
  const auto angle = [&](int i, int j) { return i < 0 || j >= n ? 0 : angles[order[i]][order[j]]; };
  for (bool improved = true; improved;) {
    improved = false;
    for (int i = 0; i < n; ++i) {
      for (int j = i + 1; j < n; ++j) {
        const double change = (i > 0 ? angles[order[i - 1]][order[j]] : 0) +
                              (j + 1 < n ? angles[order[i]][order[j + 1]] : 0) - angle(i - 1, i) -
                              angle(j, j + 1);
        if (change >= -1e-9) continue;
        std::reverse(order.begin() + i, order.begin() + j + 1);
        improved = true;
      }
    }
  }
  return order;
}

}  // namespace

void OrderShots(std::vector<Shot>& shots) {
  const size_t n = shots.size();
  if (n < 3) return;
  Angles angles(n, std::vector<double>(n));
  for (size_t i = 0; i < n; ++i) {
    for (size_t j = 0; j < n; ++j) angles[i][j] = Angle(shots[i], shots[j]);
  }
  const auto order = n <= kMostExact ? BestOrder(angles) : GoodOrder(angles);
  std::vector<Shot> ordered;
  ordered.reserve(n);
  for (const int k : order) ordered.push_back(std::move(shots[k]));
  shots = std::move(ordered);
}

}  // namespace stucco::plan
