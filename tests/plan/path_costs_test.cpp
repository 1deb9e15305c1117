// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "plan/path/candidates.h"
#include "plan/path/greedy.h"
#include "plan/path/hover_costs.h"
#include "plan/path/local_search.h"
#include "plan/path/nearest.h"
#include "plan/path/shot_order.h"
#include "tests/plan/made_hovers.h"
#include "tests/site/made_site.h"

namespace stucco::plan {
namespace {

using Eigen::Vector3d;

Shot At(double yaw, std::vector<int> facades = {}) {
  Shot shot;
  shot.yaw_rad = yaw;
  for (const int facade : facades) shot.targets.push_back({facade, {}, {}});
  return shot;
}

class HoverCostsTest : public testing::Test {
 protected:
  // Facades 0 to 3 of the first building, 4 to 7 of the second.
  Site site_ = MadeSite({Rectangle(0, 0, 20, 20), Rectangle(100, 0, 120, 20)});
  Obstacles obstacles_{site_};
  SafeSpace space_{obstacles_};
};

TEST_F(HoverCostsTest, FollowThePaper) {
  EXPECT_DOUBLE_EQ(HoverCosts::Cost(1, 10, 0), 10);
  EXPECT_DOUBLE_EQ(HoverCosts::Cost(0.5, 10, std::numbers::pi),
                   5 * std::exp(std::numbers::pi / 10));
  EXPECT_DOUBLE_EQ(HoverCosts::Cost(1, 0.5, 1), 0.5 * std::exp(1));  // no nearer than a metre
  EXPECT_EQ(HoverCosts::Cost(1, 0, std::numbers::pi), 0);
}

TEST_F(HoverCostsTest, WeighFacades) {
  const std::vector<Hover> hovers{
      {Vector3d(0, -30, 10), {At(0, {0})}}, {Vector3d(10, -30, 10), {At(0, {2, 0})}},
      {Vector3d(40, 0, 10), {At(0, {1})}},  {Vector3d(140, 0, 10), {At(0, {5})}},
      {Vector3d(50, 0, 60), {At(0)}},       {Vector3d(50, 0, 70), {}}};
  const HoverCosts costs(space_, hovers);
  EXPECT_EQ(costs.Weight(0, 1), 0.5);
  EXPECT_EQ(costs.Weight(0, 2), 0.75);
  EXPECT_EQ(costs.Weight(2, 1), 0.75);  // the best pair
  EXPECT_EQ(costs.Weight(0, 3), 1);
  EXPECT_EQ(costs.Weight(4, 4), 1);  // no targets
  EXPECT_EQ(costs.Weight(4, 5), 1);
  EXPECT_EQ(costs.Turn(9, 10), 0);  // nothing to turn from
}

TEST_F(HoverCostsTest, TurnBetweenTheEndsOfSequences) {
  const std::vector<Hover> hovers{
      {Vector3d(0, -30, 10), {At(0), At(std::numbers::pi / 2)}},
      {Vector3d(10, -30, 10), {At(std::numbers::pi / 2), At(std::numbers::pi)}}};
  const HoverCosts costs(space_, hovers);
  EXPECT_NEAR(costs.Turn(0, 2), std::numbers::pi / 2, 1e-12);
  EXPECT_NEAR(costs.Turn(1, 2), 0, 1e-12);
  EXPECT_NEAR(costs.Turn(0, 3), std::numbers::pi, 1e-12);
  EXPECT_NEAR(costs.LeastTurn(0, 1), 0, 1e-12);
}

// The bound has to hold where l exp(alpha / l) falls with l, too.
TEST_F(HoverCostsTest, NoCostIsBelowTheLeast) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> near(0, 4);
  std::uniform_real_distribution<double> turn(0, std::numbers::pi);
  for (int k = 0; k < 2000; ++k) {
    const std::vector<Hover> hovers{{Vector3d(-30, 0, 10), {At(0)}},
                                    {Vector3d(-30, near(random), 10), {At(turn(random))}}};
    const HoverCosts costs(space_, hovers);
    for (double length = costs.Straight(0, 1); length < 6; length += 0.05) {
      EXPECT_GE(HoverCosts::Cost(1, length, costs.LeastTurn(0, 1)), costs.LeastCost(0, 1) - 1e-12);
    }
  }
}

// The sum of angles between consecutive photos.
double TurningAngle(const std::vector<Shot>& shots) {
  double sum = 0;
  for (size_t k = 1; k < shots.size(); ++k) {
    const double cosine = shots[k - 1].Direction().dot(shots[k].Direction());
    sum += std::acos(std::clamp(cosine, -1.0, 1.0));
  }
  return sum;
}

TEST(ShotOrder, TurnsLeastOfAllOrders) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> angle(-std::numbers::pi / 2, std::numbers::pi / 2);
  for (int trial = 0; trial < 20; ++trial) {
    std::vector<Shot> shots;
    for (int k = 0; k < 6; ++k) {
      shots.push_back(At(2 * angle(random)));
      shots.back().pitch_rad = angle(random);
    }
    std::vector<Shot> ordered = shots;
    OrderShots(ordered);
    std::vector<int> order{0, 1, 2, 3, 4, 5};
    double least = 100;
    do {
      std::vector<Shot> trial_order;
      for (const int k : order) trial_order.push_back(shots[k]);
      least = std::min(least, TurningAngle(trial_order));
    } while (std::next_permutation(order.begin(), order.end()));
    EXPECT_NEAR(TurningAngle(ordered), least, 1e-9);
  }
}

TEST(ShotOrder, ManyPhotosOfACircleGoRound) {
  std::vector<Shot> shots;
  for (int k = 0; k < 24; ++k) shots.push_back(At(2 * std::numbers::pi * ((k * 7) % 24) / 24));
  OrderShots(shots);
  EXPECT_EQ(shots.size(), 24U);
  EXPECT_NEAR(TurningAngle(shots), 2 * std::numbers::pi * 23 / 24, 0.6);
  std::vector<Shot> none;
  OrderShots(none);
  EXPECT_TRUE(none.empty());
}

TEST(Nearest, AgreesWithTryingAll) {
  std::mt19937 random(9);
  std::uniform_int_distribution<int> at(0, 9);  // many ties
  std::vector<Vector3d> points;
  for (int k = 0; k < 300; ++k) points.emplace_back(at(random), at(random), at(random));
  const NearestPoints tree(points);
  for (int k = 0; k < 50; ++k) {
    const Vector3d from(at(random), at(random), at(random) + 0.5);
    std::vector<std::pair<double, int>> all;
    for (int j = 0; j < 300; j += 2) all.emplace_back((points[j] - from).squaredNorm(), j);
    std::sort(all.begin(), all.end());
    const auto found = tree.Find(from, 12, [](int j) { return j % 2 == 0; });
    ASSERT_EQ(found.size(), 12U);
    for (int j = 0; j < 12; ++j) EXPECT_EQ(found[j], all[j].second);
  }
  EXPECT_EQ(tree.Find({0, 0, 0}, 1000, [](int) { return true; }).size(), 300U);
  EXPECT_TRUE(NearestPoints({}).Find({0, 0, 0}, 3, [](int) { return true; }).empty());
}

TEST(LocalSearch, ImprovesATourAndKeepsItATour) {
  const Site open;
  const Obstacles nothing(open);
  const SafeSpace space(nothing);
  std::vector<Hover> hovers = RandomHovers(400, 3);
  for (Hover& hover : hovers) hover.shots.push_back(At(hover.shots[0].yaw_rad + 2));
  const HoverCosts hover_costs(space, hovers);
  const auto candidates = FindCandidates(hover_costs, 2);
  PortCosts costs(hover_costs, candidates);
  Order order{GreedyTour(hover_costs, candidates), std::vector<char>(400)};
  const double greedy = TourCost(order, costs);
  ChooseDirections(order, costs);
  const double directed = TourCost(order, costs);
  EXPECT_LT(directed, greedy);
  TourSearch search(costs, candidates, order);
  search.Improve();
  const double improved = TourCost(search.Result(), costs);
  EXPECT_LT(improved, directed);
  std::mt19937_64 random(1);
  search.Perturb(400, random);
  const Order result = search.Result();
  EXPECT_LT(TourCost(result, costs), improved);
  std::vector<int> visited = result.hovers;
  std::sort(visited.begin(), visited.end());
  for (int k = 0; k < 400; ++k) ASSERT_EQ(visited[k], k);
}

TEST(Candidates, ReachEveryHoverOfAClusteredMap) {
  const Site open;
  const Obstacles nothing(open);
  const SafeSpace space(nothing);
  std::vector<Hover> hovers;
  for (int cluster = 0; cluster < 4; ++cluster) {
    for (const Hover& hover : RandomHovers(50, cluster)) {
      hovers.push_back(hover);
      hovers.back().position += Vector3d(3000 * (cluster % 2), 3000 * (cluster / 2), 0);
    }
  }
  const HoverCosts costs(space, hovers);
  const auto candidates = FindCandidates(costs, 1);
  std::vector<int> open_list{0};
  std::vector<bool> reached(hovers.size());
  size_t count = 0;
  while (!open_list.empty()) {
    const int at = open_list.back();
    open_list.pop_back();
    if (reached[at]) continue;
    reached[at] = true;
    ++count;
    EXPECT_TRUE(std::is_sorted(candidates[at].begin(), candidates[at].end(),
                               [](const auto& a, const auto& b) { return a.cost < b.cost; }));
    for (const TourCandidate& candidate : candidates[at]) open_list.push_back(candidate.hover);
  }
  EXPECT_EQ(count, hovers.size());
}

}  // namespace
}  // namespace stucco::plan
