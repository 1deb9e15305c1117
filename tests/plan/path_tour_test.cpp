// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <numeric>
#include <random>
#include <sstream>

#include "plan/path/hover_costs.h"
#include "plan/path/tour.h"
#include "plan/path/tour_bound.h"
#include "plan/path/tour_parts.h"
#include "survey/error.h"
#include "tests/plan/made_hovers.h"
#include "tests/site/made_site.h"
#include "tests/survey/stage_support.h"

namespace stucco::plan {
namespace {

using Eigen::Vector3d;

// Cost of the tour as flown: by the paper's formula, from the hovers alone.
double CostAsFlown(const SafeSpace& space, const std::vector<Hover>& hovers) {
  const HoverCosts costs(space, hovers);
  double sum = 0;
  const int n = static_cast<int>(hovers.size());
  for (int k = 0; k < n; ++k) {
    const int next = (k + 1) % n;
    sum += HoverCosts::Cost(costs.Weight(k, next), costs.Length(k, next),
                            costs.Turn(2 * k + 1, 2 * next));
  }
  return sum;
}

// The cheapest closed tour over all orders and directions, by subsets.
double CheapestTour(const HoverCosts& costs) {
  const int n = costs.size();
  const double infinity = std::numeric_limits<double>::infinity();
  std::vector<double> edge(4 * n * n);  // by ports
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const double length = i == j ? 0 : costs.Length(i, j);
      for (const Port a : {2 * i, 2 * i + 1}) {
        for (const Port b : {2 * j, 2 * j + 1}) {
          edge[2 * n * a + b] = HoverCosts::Cost(costs.Weight(i, j), length, costs.Turn(a, b));
        }
      }
    }
  }
  double best = infinity;
  for (const Port first : {0, 1}) {  // where hover 0 is left
    // least[set][port]: from `first` through the hovers of the set, leaving the last by `port`.
    std::vector<std::vector<double>> least(1U << n, std::vector<double>(2 * n, infinity));
    least[1][first] = 0;
    for (unsigned set = 1; set < least.size(); ++set) {
      for (Port out = 0; out < 2 * n; ++out) {
        if (std::isinf(least[set][out])) continue;
        for (Port in = 2; in < 2 * n; ++in) {
          if ((set >> (in / 2)) & 1) continue;
          double& to = least[set | 1U << (in / 2)][in ^ 1];
          to = std::min(to, least[set][out] + edge[2 * n * out + in]);
        }
      }
    }
    for (Port out = 2; out < 2 * n; ++out) {
      best = std::min(best, least.back()[out] + edge[2 * n * out + (first ^ 1)]);
    }
  }
  return best;
}

// Hovers in a town, one to three photos each, at random facades.
std::vector<Hover> FewHovers(const Obstacles& obstacles, int count, uint64_t seed) {
  const Site& site = obstacles.site();
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> at(-60, 60);
  std::uniform_real_distribution<double> turn(0, 2 * std::numbers::pi);
  std::vector<Hover> hovers;
  while (static_cast<int>(hovers.size()) < count) {
    const double x = at(random);
    const Vector3d position(x, at(random), 10 + 0.4 * (60 + at(random)));
    if (!obstacles.IsFree(position)) continue;
    hovers.push_back({position, {}});
    for (int k = 1 + static_cast<int>(random() % 3); k > 0; --k) {
      const int facade = static_cast<int>(random() % site.facades.size());
      Shot shot;
      shot.yaw_rad = turn(random);
      shot.targets.push_back({facade, {}, {}});
      hovers.back().shots.push_back(shot);
    }
  }
  return hovers;
}

TEST(Tour, IsTheCheapestOfFewHoversAndTheBoundBelowIt) {
  const Site site = MadeSite(RandomTown(3, 4), {.safe_altitude_m = 40, .d_min_m = 4});
  const Obstacles obstacles(site);
  const SafeSpace space(obstacles);
  double gaps = 0;
  int tours = 0;
  for (uint64_t seed = 0; seed < 40; ++seed) {
    const int count = 2 + static_cast<int>(seed % 10);
    const Tour tour = PlanTour(space, FewHovers(obstacles, count, seed), 1);
    const HoverCosts costs(space, tour.hovers);
    const double cheapest = CheapestTour(costs);
    EXPECT_LE(tour.report.lower_bound, cheapest) << count << " hovers, seed " << seed;
    EXPECT_GE(tour.report.cost, cheapest - 1e-9) << count << " hovers, seed " << seed;
    EXPECT_LE(tour.report.cost, cheapest * (count <= 7 ? 1 + 1e-12 : 1.02)) << seed;
    EXPECT_NEAR(tour.report.cost, CostAsFlown(space, tour.hovers), 1e-9 * cheapest);
    gaps += cheapest / tour.report.lower_bound - 1;
    ++tours;
  }
  EXPECT_LT(gaps / tours, 0.10);  // a bound of nothing would be below, too
}

// A bound from candidate edges alone would be the cost of a tour through the wrong neighbours.
TEST(Tour, TheBoundHoldsWithPoorCandidates) {
  const Site site = MadeSite(RandomTown(3, 4), {.safe_altitude_m = 40, .d_min_m = 4});
  const Obstacles obstacles(site);
  const SafeSpace space(obstacles);
  for (uint64_t seed = 0; seed < 10; ++seed) {
    const auto hovers = FewHovers(obstacles, 9, seed);
    const HoverCosts costs(space, hovers);
    std::vector<std::vector<TourCandidate>> poor(9);
    for (int i = 0; i < 9; ++i) {
      int farthest = i == 0 ? 1 : 0;
      for (int j = 0; j < 9; ++j) {
        if (j != i && costs.CheapestCost(i, j) > costs.CheapestCost(i, farthest)) farthest = j;
      }
      poor[i].push_back({farthest, costs.Length(i, farthest), costs.CheapestCost(i, farthest)});
    }
    const double cheapest = CheapestTour(costs);
    const double bound = TourLowerBound(costs, poor, 1.1 * cheapest);
    EXPECT_LE(bound, cheapest) << seed;
    EXPECT_GE(bound, 0.7 * cheapest) << seed;
  }
}

// Bigger ones: Tour.Figures.
TEST(Tour, IsWithinFivePercentOfTheBound) {
  const Site open;
  const Obstacles sky(open);
  const SafeSpace space(sky);
  EXPECT_LT(PlanTour(space, RandomHovers(200, 1), 2).report.gap(), 0.03);
  EXPECT_LT(PlanTour(space, RandomHovers(1000, 2), 2).report.gap(), 0.03);
  EXPECT_LT(PlanTour(space, LatticeHovers(500), 2).report.gap(), 0.04);
  const Site town = MadeSite(RandomTown(1, 12), {.safe_altitude_m = 40, .d_min_m = 5});
  const Obstacles obstacles(town);
  EXPECT_LT(PlanTour(SafeSpace(obstacles), DippingHovers(obstacles), 2).report.gap(), 0.05);
}

// So many that stretches are searched by themselves.
TEST(Tour, OfPartsIsAsGoodAndTheSameAtAnyNumberOfThreads) {
  const Site open;
  const Obstacles sky(open);
  const SafeSpace space(sky);
  const std::vector<Hover> hovers = LatticeHovers(1200);
  const Tour one = PlanTour(space, hovers, 1);
  const Tour two = PlanTour(space, hovers, 2);
  EXPECT_EQ(one.given, two.given);
  EXPECT_LT(two.report.gap(), 0.03);
  std::vector<int> given = two.given;
  std::ranges::sort(given);
  for (int k = 0; k < static_cast<int>(hovers.size()); ++k) ASSERT_EQ(given[k], k);
}

// The ends of a stretch stay where they are, and so do the photos at them.
TEST(TourParts, MakeATourCheaperWithoutMovingTheirEnds) {
  const Site open;
  const Obstacles sky(open);
  const SafeSpace space(sky);
  const std::vector<Hover> hovers = RandomHovers(90, 3);
  const int n = static_cast<int>(hovers.size());
  const HoverCosts hover_costs(space, hovers);
  const auto candidates = FindCandidates(hover_costs, 1);
  PortCosts costs(hover_costs, candidates);
  Order start{std::vector<int>(n), std::vector<char>(n)};
  std::iota(start.hovers.begin(), start.hovers.end(), 0);
  const Order better =
      PerturbedInParts({space, hovers, candidates}, start,
                       {.parts = 3, .first = 10, .perturbations = 500}, 2, SilentProgress());
  EXPECT_LT(TourCost(better, costs), 0.7 * TourCost(start, costs));
  for (const int end : {0, 29, 30, 59, 60, 89}) {
    EXPECT_EQ(better.hovers[end], (end + 10) % n);
    EXPECT_EQ(better.reversed[(end + 10) % n], 0);
  }
}

TEST(Tour, StopsWhenCancelled) {
  stucco::test::Listener progress;
  progress.cancelled = true;
  const Site open;
  const Obstacles sky(open);
  const SafeSpace space(sky);
  EXPECT_THROW(PlanTour(space, RandomHovers(50, 1), 2, progress), Error);
}

// Sizes of STUCCO_TOUR_SIZES ("1000 5000"), with gaps and seconds on stderr: for the docs.
TEST(Tour, Figures) {
  const char* sizes = std::getenv("STUCCO_TOUR_SIZES");
  if (sizes == nullptr) GTEST_SKIP() << "STUCCO_TOUR_SIZES is not set";
  std::istringstream in(sizes);
  for (int count = 0; in >> count;) {
    const Site town = MadeSite(RandomTown(1, count / 31), {.safe_altitude_m = 40, .d_min_m = 5});
    const Obstacles obstacles(town);
    const SafeSpace space(obstacles);
    const Site open;
    const Obstacles nothing(open);
    const SafeSpace sky(nothing);
    const auto show = [](const char* what, const SafeSpace& where, std::vector<Hover> hovers) {
      const auto start = std::chrono::steady_clock::now();
      const Tour tour = PlanTour(where, std::move(hovers), 2);
      const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
      std::fprintf(stderr, "%s: %zu hovers, gap %.2f %%, %.1f s\n", what, tour.hovers.size(),
                   100 * tour.report.gap(), taken.count());
    };
    show("random", sky, RandomHovers(count, 1));
    show("lattice of five-view hovers", sky, LatticeHovers(count));
    show("dipping", space, DippingHovers(obstacles));
  }
}

}  // namespace
}  // namespace stucco::plan
