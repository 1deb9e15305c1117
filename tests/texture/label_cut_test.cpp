// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/selection/label_cut.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

namespace stucco {
namespace {

LabelProblem RandomProblem(int width, int height, int labels, double label_cost, uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> unit(0, 1);
  LabelProblem problem;
  problem.width = width;
  problem.height = height;
  problem.labels = labels;
  problem.label_cost = label_cost;
  for (size_t i = 0; i < problem.cells() * labels; ++i) problem.data.push_back(unit(random));
  for (size_t i = 0; i < problem.cells() * 2; ++i) {
    const float seam = 0.4f * unit(random);
    for (int a = 0; a < labels; ++a) {
      for (int b = 0; b < labels; ++b) problem.seams.push_back(a == b ? 0 : seam);
    }
  }
  return problem;
}

double BestEnergy(const LabelProblem& problem) {
  size_t combinations = 1;
  for (size_t i = 0; i < problem.cells(); ++i) combinations *= problem.labels;
  double best = 1e9;
  Labels labels(problem.cells());
  for (size_t k = 0; k < combinations; ++k) {
    size_t rest = k;
    for (int& label : labels) {
      label = static_cast<int>(rest % problem.labels);
      rest /= problem.labels;
    }
    best = std::min(best, LabelEnergy(problem, labels));
  }
  return best;
}

TEST(CutLabels, FindsTheOptimumOfTwoLabels) {
  for (uint32_t seed = 1; seed <= 20; ++seed) {
    const LabelProblem problem = RandomProblem(4, 3, 2, 0, seed);
    EXPECT_NEAR(LabelEnergy(problem, CutLabels(problem)), BestEnergy(problem), 1e-3) << seed;
  }
}

TEST(CutLabels, IsNearTheOptimumWithThreeLabelsThatCost) {
  for (uint32_t seed = 1; seed <= 10; ++seed) {
    const LabelProblem problem = RandomProblem(3, 3, 3, 0.5, seed);
    const double best = BestEnergy(problem);
    const double found = LabelEnergy(problem, CutLabels(problem));
    EXPECT_GE(found, best - 1e-3);
    EXPECT_LE(found, 1.05 * best) << seed;
  }
}

TEST(CutLabels, UsesFewerLabelsWhenTheyCost) {
  const auto used = [](const Labels& labels) {
    return std::set<int>(labels.begin(), labels.end()).size();
  };
  LabelProblem problem = RandomProblem(12, 12, 6, 0, 7);
  const size_t free = used(CutLabels(problem));
  problem.label_cost = 1000;
  EXPECT_GT(free, 3u);
  EXPECT_EQ(used(CutLabels(problem)), 1u);
}

TEST(CutLabels, NeverGivesForbiddenLabels) {
  LabelProblem problem = RandomProblem(6, 5, 3, 2, 3);
  for (size_t cell = 0; cell < problem.cells(); ++cell) {
    problem.data[cell * 3 + cell % 3] = LabelProblem::kForbidden;
    if (cell == 7) {
      for (int label = 0; label < 3; ++label) {
        problem.data[cell * 3 + label] = LabelProblem::kForbidden;
      }
    }
  }
  const Labels labels = CutLabels(problem);
  EXPECT_EQ(labels[7], -1);
  for (size_t cell = 0; cell < problem.cells(); ++cell) {
    if (cell == 7) continue;
    ASSERT_GE(labels[cell], 0);
    EXPECT_LT(problem.Data(cell, labels[cell]), LabelProblem::kForbidden);
  }
}

TEST(CutLabels, OfNothingIsNothing) {
  LabelProblem problem;
  EXPECT_TRUE(CutLabels(problem).empty());
  problem = RandomProblem(2, 2, 0, 1, 1);
  EXPECT_EQ(CutLabels(problem), Labels(4, -1));
}

TEST(CutLabels, IsTheSameEveryTime) {
  const LabelProblem problem = RandomProblem(20, 20, 5, 3, 11);
  EXPECT_EQ(CutLabels(problem), CutLabels(problem));
}

}  // namespace
}  // namespace stucco
