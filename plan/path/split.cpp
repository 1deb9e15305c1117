// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/path/split.h"

#include <algorithm>
#include <limits>
#include <tuple>

namespace stucco::plan {
namespace {

constexpr double kMostWork = 2e8;  // stretches from homes looked at

struct Best {
  int flights = std::numeric_limits<int>::max();
  double cost = 0;
  int before = 0;  // stops before the last flight
  int home = 0;    // of the last flight

  bool operator<(const Best& other) const {
    return std::tie(flights, cost) < std::tie(other.flights, other.cost);
  }
};

class Splitter {
 public:
  explicit Splitter(const SplitProblem& problem)
      : problem_(problem), stops_(static_cast<int>(problem.stop.size())) {}

  // Calls fn(count, cost, home) for the flights from stop `first` that the battery allows.
  template <typename Fn>
  void ForFlights(int first, int most, const Fn& fn) const {
    for (size_t home = 0; home < problem_.homes.size(); ++home) {
      const SplitHome& from = problem_.homes[home];
      double cost = from.fixed + from.out[first];
      double budget = problem_.budget;
      int last = first;
      for (int count = 1; count <= most; ++count) {
        cost += problem_.stop[last];
        budget = std::min(budget, problem_.budget - from.reserve[last]);
        if (!(cost <= budget)) break;
        const double whole = cost + from.back[last];
        if (whole <= budget) fn(count, whole + problem_.cut[last], static_cast<int>(home));
        cost += problem_.next[last];
        last = last + 1 == stops_ ? 0 : last + 1;
      }
    }
  }

  // Dynamic programming over the stops from `start` on: the best way to fly the first k of them.
  std::vector<Best> Solve(int start) const {
    std::vector<Best> best(stops_ + 1);
    best[0].flights = 0;
    for (int k = 0; k < stops_; ++k) {
      if (best[k].flights == std::numeric_limits<int>::max()) continue;
      ForFlights((start + k) % stops_, stops_ - k, [&](int count, double cost, int home) {
        const Best through{best[k].flights + 1, best[k].cost + cost, k, home};
        if (through < best[k + count]) best[k + count] = through;
      });
    }
    return best;
  }

  // Whichever flight visits the first stop, the next begins at most this many stops later.
  int Starts() const {
    int starts = 0;
    for (double cost = 0; starts < stops_; ++starts) {
      cost += problem_.stop[starts];
      if (cost > problem_.budget) break;
      cost += problem_.next[starts];
    }
    return std::min(starts + 1, stops_);
  }

 private:
  const SplitProblem& problem_;
  int stops_;
};

std::vector<Stretch> StretchesOf(const std::vector<Best>& solution, int start) {
  const int stops = static_cast<int>(solution.size()) - 1;
  std::vector<Stretch> stretches;
  for (int k = stops; k > 0; k = solution[k].before) {
    const int before = solution[k].before;
    stretches.push_back({(start + before) % stops, k - before, solution[k].home});
  }
  std::reverse(stretches.begin(), stretches.end());
  return stretches;
}

}  // namespace

std::vector<Stretch> SplitTour(const SplitProblem& problem) {
  const int stops = static_cast<int>(problem.stop.size());
  if (stops == 0) return {};
  const Splitter splitter(problem);
  const int starts = splitter.Starts();
  const double work = static_cast<double>(stops) * starts * problem.homes.size();
  const int tried = std::clamp(static_cast<int>(kMostWork / work), 1, starts);
  int best_start = 0;
  Best best;
  for (int k = 0; k < tried; ++k) {
    const int start = static_cast<int>(static_cast<int64_t>(k) * starts / tried);
    const Best found = splitter.Solve(start).back();
    if (found < best) {
      best = found;
      best_start = start;
    }
  }
  return StretchesOf(splitter.Solve(best_start), best_start);
}

}  // namespace stucco::plan
