// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>

#include "plan/path/split.h"

namespace stucco::plan {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Infinite where the battery does not last.
double FlightCost(const SplitProblem& problem, const Stretch& flight) {
  const int n = static_cast<int>(problem.stop.size());
  const SplitHome& home = problem.homes[flight.home];
  const int last = (flight.first + flight.count - 1) % n;
  double cost = home.fixed + home.out[flight.first] + home.back[last];
  double reserve = 0;
  for (int k = 0; k < flight.count; ++k) {
    const int at = (flight.first + k) % n;
    cost += problem.stop[at];
    if (k + 1 < flight.count) cost += problem.next[at];
    reserve = std::max(reserve, home.reserve[at]);
  }
  return cost + reserve <= problem.budget ? cost + problem.cut[last] : kInfinity;
}

double FromBestHome(const SplitProblem& problem, int first, int count) {
  double least = kInfinity;
  for (int home = 0; home < static_cast<int>(problem.homes.size()); ++home) {
    least = std::min(least, FlightCost(problem, {first, count, home}));
  }
  return least;
}

// All sets of places where the circle may be cut, each flight from its best home.
std::pair<int, double> BruteForce(const SplitProblem& problem) {
  const int n = static_cast<int>(problem.stop.size());
  std::pair<int, double> best{std::numeric_limits<int>::max(), 0};
  for (unsigned cuts = 1; cuts < 1U << n; ++cuts) {
    std::vector<int> starts;
    for (int k = 0; k < n; ++k) {
      if ((cuts >> k) & 1) starts.push_back(k);
    }
    double cost = 0;
    for (size_t k = 0; k < starts.size(); ++k) {
      const int next = k + 1 < starts.size() ? starts[k + 1] : starts[0] + n;
      cost += FromBestHome(problem, starts[k], next - starts[k]);
    }
    if (cost < kInfinity) best = std::min(best, {static_cast<int>(starts.size()), cost});
  }
  return best;
}

SplitProblem RandomProblem(int stops, int homes, std::mt19937& random) {
  std::uniform_real_distribution<double> cost(10, 100);
  SplitProblem problem;
  problem.homes.resize(homes);
  for (SplitHome& home : problem.homes) {
    home.fixed = cost(random) / 10;
    for (int k = 0; k < stops; ++k) {
      home.out.push_back(cost(random));
      home.back.push_back(cost(random));
      home.reserve.push_back(cost(random) / 4);
    }
  }
  for (int k = 0; k < stops; ++k) {
    problem.stop.push_back(cost(random) / 10);
    problem.next.push_back(cost(random) / 2);
    problem.cut.push_back(k % 3 == 0 ? cost(random) / 3 : 0);
  }
  problem.budget = 245 + 2 * cost(random);
  return problem;
}

TEST(SplitTour, IsTheBestOfAllCutsAndHomes) {
  std::mt19937 random(5);
  for (int trial = 0; trial < 200; ++trial) {
    const int n = 1 + trial % 10;
    SplitProblem problem = RandomProblem(n, 1 + trial % 3, random);
    if (problem.homes.size() > 1) problem.homes[1].out[trial % n] = kInfinity;
    const auto flights = SplitTour(problem);
    std::vector<int> visited;
    double sum = 0;
    for (const Stretch& flight : flights) {
      sum += FlightCost(problem, flight);
      for (int k = 0; k < flight.count; ++k) visited.push_back((flight.first + k) % n);
    }
    const auto [least, cheapest] = BruteForce(problem);
    EXPECT_EQ(static_cast<int>(flights.size()), least);
    EXPECT_NEAR(sum, cheapest, 1e-9);
    ASSERT_EQ(static_cast<int>(visited.size()), n);
    for (int k = 1; k < n; ++k) EXPECT_EQ(visited[k], (visited[k - 1] + 1) % n);
  }
}

SplitProblem EvenProblem(int stops) {
  const std::vector<double> ones(stops, 1);
  SplitProblem problem;
  problem.homes = {{0, ones, ones, std::vector<double>(stops, 0)}};
  problem.stop = ones;
  problem.next = ones;
  problem.cut = std::vector<double>(stops, 0);
  problem.budget = 9;  // four stops and three legs between them, out and back
  return problem;
}

TEST(SplitTour, CutsWhereItIsNotWorthMuch) {
  SplitProblem problem = EvenProblem(8);
  ASSERT_EQ(SplitTour(problem).size(), 2u);
  for (const int k : {0, 1, 3, 4, 5, 7}) problem.cut[k] = 0.1;
  std::vector<int> first;
  for (const Stretch& flight : SplitTour(problem)) first.push_back(flight.first);
  std::ranges::sort(first);
  EXPECT_EQ(first, (std::vector<int>{3, 7}));
}

TEST(SplitTour, KeepsMoreInReserveFartherAway) {
  SplitProblem problem = EvenProblem(8);
  EXPECT_EQ(SplitTour(problem).size(), 2u);
  problem.homes[0].reserve[5] = 2;
  EXPECT_EQ(SplitTour(problem).size(), 3u);
}

TEST(SplitTour, NoStopsNoFlights) {
  EXPECT_TRUE(SplitTour({}).empty());
}

}  // namespace
}  // namespace stucco::plan
