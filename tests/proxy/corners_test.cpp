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

TEST(WithoutSteps, TakesOffWhatNoWallHoldsAtACorner) {
  // Eaves stand 0.5 m out over the last two metres before the corner.
  constexpr double kOut_m = 0.5;
  const auto held = [](const Segment2d& edge) {
    return IsAlongAnAxis(edge) && std::max(edge.a.y(), edge.b.y()) < 6.25;
  };
  Ring stepped = {{0, 0}, {8, 0}, {8, 6 + kOut_m}, {6, 6 + kOut_m}, {6.1, 6}, {0, 6}};
  for (size_t i = 0; i < stepped.size(); ++i) {
    std::rotate(stepped.begin(), stepped.begin() + 1, stepped.end());
    // The wall at 8 goes too far, and is held by less than all of its edge here.
    const Ring whole = WithoutSteps(
        stepped,
        [&](const Segment2d& edge) { return held(edge) || (edge.a.x() == 8 && edge.b.x() == 8); },
        kReach_m, 0.6);
    ASSERT_THAT(whole, SizeIs(4));
    EXPECT_DOUBLE_EQ(SignedArea(whole), 48);
  }
}

TEST(WithoutSteps, TakesOffABalcony) {
  const auto held = [](const Segment2d& edge) {
    return IsAlongAnAxis(edge) && std::abs(edge.a.y() - edge.b.y()) < 0.01 && edge.a.y() < 6.5;
  };
  const auto walls = [&](const Segment2d& edge) {
    return held(edge) || (edge.a.x() == edge.b.x() && (edge.a.x() == 0 || edge.a.x() == 8));
  };
  const Ring with_balcony = {{0, 0}, {8, 0}, {8, 6}, {5, 6}, {5, 7}, {3, 7}, {3, 6}, {0, 6}};
  const Ring whole = WithoutSteps(with_balcony, walls, kReach_m, 1.2);
  EXPECT_THAT(whole, SizeIs(4));
  EXPECT_DOUBLE_EQ(SignedArea(whole), 48);
  // One that is deeper, or longer, is something else.
  EXPECT_THAT(WithoutSteps(with_balcony, walls, kReach_m, 0.9), SizeIs(8));
  EXPECT_THAT(WithoutSteps(with_balcony, walls, 1.9, 1.2), SizeIs(8));
}

TEST(WithoutSteps, LeavesWhatWallsHold) {
  const Ring stepped = {{0, 0}, {8, 0}, {8, 6}, {5, 6}, {5, 7}, {3, 7}, {3, 6}, {0, 6}};
  const auto everything = [](const Segment2d&) { return true; };
  const auto nothing = [](const Segment2d&) { return false; };
  EXPECT_THAT(WithoutSteps(stepped, everything, kReach_m, 1.2), SizeIs(8));
  EXPECT_THAT(WithoutSteps(stepped, nothing, kReach_m, 1.2), SizeIs(8));
  // One wall alone says nothing about what goes on around the house.
  const auto one = [](const Segment2d& edge) { return edge.a.y() == 0 && edge.b.y() == 0; };
  EXPECT_THAT(WithoutSteps(stepped, one, kReach_m, 1.2), SizeIs(8));
}

}  // namespace
}  // namespace stucco
