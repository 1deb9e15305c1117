// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/planes/densest.h"

#include <gtest/gtest.h>

#include <vector>

namespace stucco {
namespace {

TEST(MeanOfDensest, OfOneNumberIsIt) {
  EXPECT_EQ(MeanOfDensest(std::vector<double>{3.5}, 0.1), 3.5);
}

TEST(MeanOfDensest, LeavesOutWhatMostDoNotShow) {
  // A roof at 4 and more samples above it, up to the top of its parapet.
  std::vector<double> heights;
  for (int i = -50; i < 50; ++i) heights.push_back(4 + 0.001 * i);
  for (int i = 1; i < 120; ++i) heights.push_back(4.05 + 0.005 * i);
  EXPECT_NEAR(MeanOfDensest(heights, 0.12), 4, 0.01);
}

TEST(MeanOfDensest, OfEqualWindowsTheFirst) {
  EXPECT_EQ(MeanOfDensest(std::vector<double>{1, 1, 5, 5}, 0.5), 1);
}

}  // namespace
}  // namespace stucco
