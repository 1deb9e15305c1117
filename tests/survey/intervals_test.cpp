// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/intervals.h"

#include <gtest/gtest.h>

#include <random>

namespace stucco {
namespace {

TEST(Intervals, UnionJoinsWhatTouchesAndDropsWhatIsEmpty) {
  EXPECT_EQ(Union({{4, 5}, {1, 2}, {2, 3}, {7, 7}, {1.5, 2.5}}), (Intervals{{1, 3}, {4, 5}}));
}

TEST(Intervals, GapsAreTheRestOfTheWindow) {
  const Intervals set{{-1, 1}, {2, 3}, {9, 12}};
  EXPECT_EQ(Gaps(set, {0, 10}), (Intervals{{1, 2}, {3, 9}}));
  EXPECT_EQ(Gaps(Intervals{}, {0, 10}), (Intervals{{0, 10}}));
  EXPECT_TRUE(Gaps(set, {9.5, 11}).empty());
}

TEST(Intervals, TouchingIntervalsHaveNothingInCommon) {
  EXPECT_FALSE(Intersection(Interval{0, 1}, Interval{1, 2}).has_value());
}

// Against membership of random points.
TEST(Intervals, AgreeWithMembershipOfPoints) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(0, 10);
  const auto make = [&] {
    Intervals set;
    for (int i = 0; i < 6; ++i) {
      const double from = uniform(random);
      set.push_back({from, from + uniform(random) / 5});
    }
    return Union(set);
  };
  const auto holds = [](const Intervals& set, double x) {
    for (const Interval& i : set) {
      if (i.from_m <= x && x <= i.to_m) return true;
    }
    return false;
  };
  for (int round = 0; round < 200; ++round) {
    const Intervals a = make(), b = make();
    const Intervals both = Intersection(a, b), only_a = Difference(a, b);
    EXPECT_NEAR(Length(both) + Length(only_a), Length(a), 1e-9);
    for (int i = 0; i < 20; ++i) {
      const double x = uniform(random);
      EXPECT_EQ(holds(both, x), holds(a, x) && holds(b, x));
      EXPECT_EQ(holds(only_a, x), holds(a, x) && !holds(b, x));
    }
  }
}

}  // namespace
}  // namespace stucco
