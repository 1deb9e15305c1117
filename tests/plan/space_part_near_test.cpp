// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <random>

#include "plan/space/part_near.h"

namespace stucco::plan {
namespace {

TEST(PartNear, IsThatOfACapsule) {
  const Segment2d wall{{0, 0}, {0, 10}};
  const auto across = PartNear({{-10, 5}, {10, 5}}, wall, 4);
  ASSERT_TRUE(across);
  EXPECT_NEAR(across->from_m, 0.3, 1e-12);
  EXPECT_NEAR(across->to_m, 0.7, 1e-12);
  const auto round_the_end = PartNear({{-10, 13}, {10, 13}}, wall, 5);
  ASSERT_TRUE(round_the_end);
  EXPECT_NEAR(round_the_end->from_m, 0.3, 1e-12);
  EXPECT_NEAR(round_the_end->to_m, 0.7, 1e-12);
  EXPECT_FALSE(PartNear({{-10, 15}, {10, 15}}, wall, 5));  // touches only
  EXPECT_FALSE(PartNear({{5, 0}, {5, 10}}, wall, 5));
  EXPECT_EQ(PartNear({{1, 5}, {1, 5}}, wall, 5), (Interval{0, 1}));
  EXPECT_FALSE(PartNear({{1, 5}, {1, 5}}, {{9, 9}, {9, 9}}, 5));
}

TEST(PartNear, AgreesWithDistances) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> at(-10, 10);
  const auto point = [&] { return Eigen::Vector2d(at(random), at(random)); };
  for (int k = 0; k < 500; ++k) {
    const Segment2d s{point(), point()};
    const Segment2d t{point(), point()};
    const auto part = PartNear(s, t, 3);
    EXPECT_EQ(part.has_value(), SquaredDistance(s, t) < 9);
    for (double at_s = 0; at_s <= 1; at_s += 0.01) {
      const double squared = SquaredDistance(t, Eigen::Vector2d(s.a + at_s * (s.b - s.a)));
      if (std::abs(squared - 9) < 1e-9) continue;
      EXPECT_EQ(squared < 9, part && at_s >= part->from_m && at_s <= part->to_m);
    }
  }
}

}  // namespace
}  // namespace stucco::plan
