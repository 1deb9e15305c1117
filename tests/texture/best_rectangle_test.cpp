// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/relief/best_rectangle.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <utility>
#include <vector>

namespace stucco::test {
namespace {

double SumOf(const std::vector<float>& values, int width, const CellRectangle& cells) {
  double sum = 0;
  for (int y = cells.top; y < cells.bottom; ++y) {
    for (int x = cells.left; x < cells.right; ++x) sum += values[y * width + x];
  }
  return sum;
}

double BestByTrial(const std::vector<float>& values, int width, int height) {
  double best = 0;
  for (int top = 0; top < height; ++top) {
    for (int bottom = top + 1; bottom <= height; ++bottom) {
      for (int left = 0; left < width; ++left) {
        for (int right = left + 1; right <= width; ++right) {
          best = std::max(best, SumOf(values, width, {left, top, right, bottom}));
        }
      }
    }
  }
  return best;
}

TEST(BestRectangle, IsTheBestOfAllUprightAndLying) {
  std::mt19937 random(3);
  for (const auto& [width, height] : {std::pair(9, 6), std::pair(5, 11), std::pair(1, 7)}) {
    for (int trial = 0; trial < 20; ++trial) {
      std::vector<float> values;
      values.reserve(width * height);
      for (int i = 0; i < width * height; ++i) {
        values.push_back(static_cast<float>(random() % 21) - 11);
      }
      const RectangleSum best = BestRectangle(values, width, height);
      EXPECT_DOUBLE_EQ(best.sum, BestByTrial(values, width, height));
      EXPECT_DOUBLE_EQ(best.sum, SumOf(values, width, best.cells));
    }
  }
}

TEST(BestRectangle, IsEmptyWhereNothingIsPositive) {
  const std::vector<float> values(12, -1);
  const RectangleSum best = BestRectangle(values, 4, 3);
  EXPECT_EQ(best.sum, 0);
  EXPECT_EQ(best.cells.Cells(), 0);
}

}  // namespace
}  // namespace stucco::test
