// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/localise/point_keypoints.h"

#include <gtest/gtest.h>

namespace stucco {
namespace {

TEST(PointsOfKeypoints, TakesTheNearestWithinReach) {
  RegisteredImage image;
  image.observations = {{{10, 10}, PointId{1}},
                        {{11, 10}, PointId{2}},
                        {{50, 20}, PointId{3}},
                        {{70, 20}, PointId{}}};  // without a point
  const std::vector<PointId> points = PointsOfKeypoints(
      {{10.2f, 10, 1}, {10.9f, 10.1f, 1}, {50, 21.5f, 1}, {50.5f, 20.5f, 1}, {70, 20, 1}}, image,
      1);
  EXPECT_EQ(points, (std::vector<PointId>{PointId{1}, PointId{2}, {}, PointId{3}, {}}));
}

TEST(PointsOfKeypoints, NoObservationsGiveNoPoints) {
  EXPECT_EQ(PointsOfKeypoints({{1, 2, 3}}, {}, 1), std::vector<PointId>(1));
}

TEST(MostVoted, OnePointAKeypointAndOneKeypointAPoint) {
  // Keypoint 4 is said to show point 9 twice and point 8 once; point 9 also by keypoint 5, once.
  const std::vector<PointVote> chosen = MostVoted(
      {{4, PointId{8}}, {5, PointId{9}}, {4, PointId{9}}, {4, PointId{9}}, {2, PointId{7}}});
  ASSERT_EQ(chosen.size(), 2u);
  EXPECT_EQ(chosen[0].keypoint, 2);
  EXPECT_EQ(chosen[0].point, PointId{7});
  EXPECT_EQ(chosen[1].keypoint, 4);
  EXPECT_EQ(chosen[1].point, PointId{9});
}

}  // namespace
}  // namespace stucco
