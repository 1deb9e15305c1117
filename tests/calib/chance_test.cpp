// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/features/chance.h"

#include <gtest/gtest.h>

#include <cmath>

namespace stucco::test {
namespace {

TEST(LogBinomialTail, IsTheSumOfTheTerms) {
  EXPECT_NEAR(std::exp(LogBinomialTail(10, 8, 0.5)), 56.0 / 1024, 1e-12);
  EXPECT_NEAR(std::exp(LogBinomialTail(3, 1, 0.1)), 1 - 0.9 * 0.9 * 0.9, 1e-12);
  EXPECT_NEAR(LogBinomialTail(1000, 1000, 1e-3), 1000 * std::log(1e-3), 1e-6);
}

TEST(LogBinomialTail, IsOneWhereNothingIsAskedAndNoneWhereTooMuchIs) {
  EXPECT_EQ(LogBinomialTail(10, 0, 0.3), 0);
  EXPECT_EQ(LogBinomialTail(10, 10, 1), 0);
  EXPECT_TRUE(std::isinf(LogBinomialTail(10, 11, 0.3)));
  EXPECT_TRUE(std::isinf(LogBinomialTail(10, 1, 0)));
  EXPECT_NEAR(LogBinomialTail(100000, 10, 0.5), 0, 1e-9);
}

TEST(LogFalseAlarms, AreFewWhenMoreAgreeThanChanceLets) {
  ChanceFinding finding{100, 40, 7, 3, 0.02};
  EXPECT_LT(LogFalseAlarms(finding), std::log(1e-3));
  finding.num_inliers = 16;
  EXPECT_GT(LogFalseAlarms(finding), 0);
}

TEST(LogFalseAlarms, AreTheModelsTimesTheChance) {
  EXPECT_NEAR(std::exp(LogFalseAlarms({6, 6, 4, 2, 0.5})), 2 * 15 * 0.25, 1e-9);
}

TEST(LogFalseAlarms, AreAllWhereOnlyTheSampleAgrees) {
  EXPECT_GT(LogFalseAlarms({7, 7, 7, 1, 0.02}), 1e9);
  EXPECT_GT(LogFalseAlarms({5, 5, 7, 1, 0.02}), 1e9);
}

}  // namespace
}  // namespace stucco::test
