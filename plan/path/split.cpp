// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/path/split.h"

#include <algorithm>
#include <limits>
#include <tuple>

namespace stucco::plan {
namespace {

constexpr double kMostWork = 4e8;  // stretches looked at

struct Best {
  int flights = std::numeric_limits<int>::max();
  double length_m = 0;
  int before = 0;  // stops before the last flight

  bool operator<(const Best& other) const {
    return std::tie(flights, length_m) < std::tie(other.flights, other.length_m);
  }
};

class Splitter {
 public:
  explicit Splitter(const SplitProblem& problem)
      : problem_(problem), stops_(static_cast<int>(problem.home_m.size())) {}

  // Calls fn(count, length) for the flights from stop `first` that the battery allows.
  template <typename Fn>
  void ForFlights(int first, int most, const Fn& fn) const {
    double length = problem_.home_m[first];
    int last = first;
    for (int count = 1; count <= most; ++count) {
      const double budget = problem_.length_budget_m - count * problem_.stop_length_m;
      if (length > budget) return;
      const double whole = length + problem_.home_m[last];
      if (whole <= budget) fn(count, whole);
      length += problem_.next_m[last];
      last = last + 1 == stops_ ? 0 : last + 1;
    }
  }

  // Dynamic programming over the stops from `start` on: the best way to fly the first k of them.
  std::vector<Best> Solve(int start) const {
    std::vector<Best> best(stops_ + 1);
    best[0].flights = 0;
    for (int k = 0; k < stops_; ++k) {
      if (best[k].flights == std::numeric_limits<int>::max()) continue;
      ForFlights((start + k) % stops_, stops_ - k, [&](int count, double length) {
        const Best through{best[k].flights + 1, best[k].length_m + length, k};
        if (through < best[k + count]) best[k + count] = through;
      });
    }
    return best;
  }

 private:
  const SplitProblem& problem_;
  int stops_;
};

}  // namespace

std::vector<Stretch> SplitTour(const SplitProblem& problem) {
  const int stops = static_cast<int>(problem.home_m.size());
  if (stops == 0) return {};
  const Splitter splitter(problem);
  // Whichever flight visits the first stop, the next begins at most this many stops later.
  int starts = 0;
  for (double length = 0; starts < stops; ++starts) {
    if (length > problem.length_budget_m - (starts + 1) * problem.stop_length_m) break;
    length += problem.next_m[starts];
  }
  starts = std::min(starts + 1, stops);
  const int tried =
      std::clamp(static_cast<int>(kMostWork / (static_cast<double>(stops) * starts)), 1, starts);
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
  const std::vector<Best> solution = splitter.Solve(best_start);
  std::vector<Stretch> stretches;
  for (int k = stops; k > 0; k = solution[k].before) {
    const int before = solution[k].before;
    stretches.push_back({(best_start + before) % stops, k - before});
  }
  std::reverse(stretches.begin(), stretches.end());
  return stretches;
}

}  // namespace stucco::plan
