// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "plan/path/split.h"

namespace stucco::plan {
namespace {

double FlightLength(const SplitProblem& problem, int first, int count) {
  const int n = static_cast<int>(problem.home_m.size());
  double length = problem.home_m[first] + problem.home_m[(first + count - 1) % n];
  for (int k = 0; k + 1 < count; ++k) length += problem.next_m[(first + k) % n];
  return length;
}

bool Fits(const SplitProblem& problem, int first, int count) {
  return FlightLength(problem, first, count) + count * problem.stop_length_m <=
         problem.length_budget_m;
}

// All sets of places where the circle may be cut.
std::pair<int, double> BruteForce(const SplitProblem& problem) {
  const int n = static_cast<int>(problem.home_m.size());
  std::pair<int, double> best{std::numeric_limits<int>::max(), 0};
  for (unsigned cuts = 1; cuts < 1U << n; ++cuts) {
    std::vector<int> starts;
    for (int k = 0; k < n; ++k) {
      if ((cuts >> k) & 1) starts.push_back(k);
    }
    double length = 0;
    bool fits = true;
    for (size_t k = 0; k < starts.size(); ++k) {
      const int next = k + 1 < starts.size() ? starts[k + 1] : starts[0] + n;
      fits = fits && Fits(problem, starts[k], next - starts[k]);
      length += FlightLength(problem, starts[k], next - starts[k]);
    }
    if (fits) best = std::min(best, {static_cast<int>(starts.size()), length});
  }
  return best;
}

TEST(SplitTour, IsTheBestOfAllCuts) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> length(10, 100);
  for (int trial = 0; trial < 200; ++trial) {
    SplitProblem problem;
    const int n = 1 + trial % 11;
    for (int k = 0; k < n; ++k) {
      problem.home_m.push_back(length(random));
      problem.next_m.push_back(length(random) / 2);
    }
    problem.stop_length_m = 5;
    problem.length_budget_m = 210 + 2 * length(random);
    const auto flights = SplitTour(problem);
    std::vector<int> visited;
    double sum = 0;
    for (const Stretch& flight : flights) {
      EXPECT_TRUE(Fits(problem, flight.first, flight.count));
      sum += FlightLength(problem, flight.first, flight.count);
      for (int k = 0; k < flight.count; ++k) visited.push_back((flight.first + k) % n);
    }
    const auto [least, shortest] = BruteForce(problem);
    EXPECT_EQ(static_cast<int>(flights.size()), least);
    EXPECT_NEAR(sum, shortest, 1e-9);
    ASSERT_EQ(static_cast<int>(visited.size()), n);
    for (int k = 1; k < n; ++k) EXPECT_EQ(visited[k], (visited[k - 1] + 1) % n);
  }
}

TEST(SplitTour, NoStopsNoFlights) {
  EXPECT_TRUE(SplitTour({}).empty());
}

}  // namespace
}  // namespace stucco::plan
