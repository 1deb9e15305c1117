// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/adjust/internal/draws.h"

#include <gtest/gtest.h>

#include <cmath>

namespace stucco::test {
namespace {

TEST(Draws, SignsAreBalancedAndEachKeyHasItsOwn) {
  constexpr int kKeys = 200;
  const double usual = std::sqrt(Draws::kCount);
  for (uint64_t key = 0; key < kKeys; ++key) {
    const Draws::Signs signs = Draws::SignsOf(key);
    EXPECT_EQ(signs, Draws::SignsOf(key));
    EXPECT_EQ(signs.cwiseAbs().sum(), Draws::kCount);
    EXPECT_LT(std::abs(signs.sum()), 5 * usual) << key;
    EXPECT_LT(std::abs(signs.dot(Draws::SignsOf(key + 1))), 5 * usual) << key;
  }
}

// Errors with signs of their own add up by their squares, those with the same signs by their size.
TEST(Draws, ScatterAsTheirErrorsDo) {
  constexpr int kErrors = 100;
  Draws draws(2);
  const Eigen::VectorXd one = Eigen::VectorXd::Ones(1);
  for (int i = 0; i < kErrors; ++i) {
    draws.Add(0, Draws::SignsOf(i), one);
    draws.Add(1, Draws::SignsOf(0), one);
  }
  const Eigen::Vector2d scatter = draws.rows().colwise().norm() / std::sqrt(Draws::kCount);
  EXPECT_NEAR(scatter[0], std::sqrt(kErrors), 1.5);
  EXPECT_NEAR(scatter[1], kErrors, 1e-9);
}

}  // namespace
}  // namespace stucco::test
