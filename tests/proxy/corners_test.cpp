// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/map/corners.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace stucco {
namespace {

using testing::SizeIs;

constexpr double kReach_m = 2.5;

// Edges along the axes are held.
bool IsAlongAnAxis(const Segment2d& edge) {
  const Eigen::Vector2d way = edge.b - edge.a;
  return std::min(std::abs(way.x()), std::abs(way.y())) < 1e-9;
}

TEST(WithCorners, CompletesACornerThatWasCutOff) {
  const Ring cut = {{0, 0}, {8, 0}, {8, 5}, {7, 6}, {0, 6}};
  const Ring whole = WithCorners(cut, IsAlongAnAxis, kReach_m);
  ASSERT_THAT(whole, SizeIs(4));
  EXPECT_EQ(whole[2], Eigen::Vector2d(8, 6));
  EXPECT_DOUBLE_EQ(SignedArea(whole), 48);
}

TEST(WithCorners, WhereverTheRingBegins) {
  Ring cut = {{0, 0}, {8, 0}, {8, 5}, {7, 6}, {0, 6}};
  for (size_t i = 0; i < cut.size(); ++i) {
    std::rotate(cut.begin(), cut.begin() + 1, cut.end());
    EXPECT_DOUBLE_EQ(SignedArea(WithCorners(cut, IsAlongAnAxis, kReach_m)), 48);
  }
}

TEST(WithCorners, TakesBackWhatGoesTooFar) {
  // The wall at 8 is met by an edge that began a metre outside of it.
  const Ring jutting = {{0, 0}, {9, 0}, {8, 2}, {8, 6}, {0, 6}};
  EXPECT_DOUBLE_EQ(SignedArea(WithCorners(jutting, IsAlongAnAxis, kReach_m)), 48);
}

TEST(WithCorners, InwardCornersToo) {
  const Ring cut = {{0, 0}, {8, 0}, {8, 3}, {5, 3}, {4, 4}, {4, 8}, {0, 8}};
  EXPECT_DOUBLE_EQ(SignedArea(WithCorners(cut, IsAlongAnAxis, kReach_m)), 8 * 3 + 4 * 5);
}

TEST(WithCorners, LeavesWhatIsHeldOrTooLong) {
  const Ring cut = {{0, 0}, {8, 0}, {8, 5}, {7, 6}, {0, 6}};
  EXPECT_EQ(WithCorners(
                cut, [](const Segment2d&) { return true; }, kReach_m),
            cut);
  const Ring long_cut = {{0, 0}, {8, 0}, {8, 3}, {5, 6}, {0, 6}};
  EXPECT_EQ(WithCorners(long_cut, IsAlongAnAxis, kReach_m), long_cut);
  const Ring nothing_held = {{0, 0}, {8, 1}, {7, 6}, {1, 5}};
  EXPECT_EQ(WithCorners(nothing_held, IsAlongAnAxis, kReach_m), nothing_held);
}

}  // namespace
}  // namespace stucco
