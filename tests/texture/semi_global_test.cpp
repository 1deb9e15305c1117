// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/semi_global.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace stucco::test {
namespace {

// Label 1 on the left, 4 on the right of 20 x 10 cells.
int Truth(int x) {
  return x < 12 ? 1 : 4;
}

LabelCosts NoisyStep(double noise) {
  LabelCosts costs{20, 10, 6, {}};
  std::mt19937 random(7);
  for (int cell = 0; cell < 200; ++cell) {
    for (int label = 0; label < 6; ++label) {
      const double r = static_cast<double>(random()) / static_cast<double>(std::mt19937::max());
      costs.costs.push_back(static_cast<float>((label == Truth(cell % 20) ? 0 : 0.4) + noise * r));
    }
  }
  return costs;
}

int Wrong(const std::vector<int>& labels) {
  int wrong = 0;
  for (int cell = 0; cell < 200; ++cell) wrong += labels[cell] != Truth(cell % 20);
  return wrong;
}

TEST(MatchSemiGlobally, KeepsAStepAndDropsNoise) {
  EXPECT_EQ(Wrong(MatchSemiGlobally(NoisyStep(0.3), 0.2f, 0.5f)), 0);
  EXPECT_GT(Wrong(MatchSemiGlobally(NoisyStep(0.8), 0, 0)), 30);  // each cell by itself
  EXPECT_LT(Wrong(MatchSemiGlobally(NoisyStep(0.8), 0.4f, 1)), 10);
}

TEST(MatchSemiGlobally, FillsPlainCellsFromAround) {
  LabelCosts costs = NoisyStep(0);
  for (int y = 3; y < 7; ++y) {
    for (int x = 14; x < 18; ++x) {
      for (int label = 0; label < 6; ++label) costs.costs[(y * 20 + x) * 6 + label] = 0.4f;
    }
  }
  EXPECT_EQ(Wrong(MatchSemiGlobally(costs, 0.2f, 0.5f)), 0);
}

}  // namespace
}  // namespace stucco::test
