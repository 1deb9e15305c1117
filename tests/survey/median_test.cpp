// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/median.h"

#include <gtest/gtest.h>

namespace stucco {
namespace {

TEST(Median, IsTheUpperOfTwo) {
  EXPECT_EQ(Median({5, 1, 4}), 4);
  EXPECT_EQ(Median({4, 1, 5, 2}), 4);
  EXPECT_EQ(Median({}), std::nullopt);
}

TEST(Quantile, IsTheNearestRank) {
  EXPECT_EQ(Quantile({5, 1, 4, 2, 3}, 0.95), 5);
  EXPECT_EQ(Quantile({5, 1, 4, 2, 3}, 0.6), 3);
  EXPECT_EQ(Quantile({7}, 0), 7);
  EXPECT_EQ(Quantile({}, 0.95), std::nullopt);
}

TEST(QuantileDeathTest, RequiresAShare) {
  EXPECT_DEATH(Quantile({1}, 1.5), "share");
}

}  // namespace
}  // namespace stucco
