// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/relief/wall_edges.h"

#include <gtest/gtest.h>

namespace stucco {
namespace {

// A wall of 40 x 30 cells with a dark window from (10, 8) to (22, 24), and a bar in its middle that
// lies behind the plane: blurred over three cells.
class WallEdgesTest : public testing::Test {
 protected:
  WallEdgesTest() {
    sweep_.raster.width = 40;
    sweep_.raster.height = 30;
    sweep_.grey.assign(sweep_.raster.size(), 150);
    for (int y = 8; y < 24; ++y) {
      for (int x = 10; x < 22; ++x) Grey(x, y) = 60;
      for (int x = 15; x < 18; ++x) Grey(x, y) = x == 16 ? 68.0f : 64.0f;
    }
  }
  float& Grey(int x, int y) { return sweep_.grey[static_cast<size_t>(y) * 40 + x]; }

  PlaneSweep sweep_;
};

bool operator==(const CellRectangle& a, const CellRectangle& b) {
  return a.left == b.left && a.top == b.top && a.right == b.right && a.bottom == b.bottom;
}

TEST_F(WallEdgesTest, AreSharpWhereTheWallEnds) {
  const WallEdges edges(sweep_);
  for (const float edge : edges.Along({10, 8, 22, 24})) EXPECT_EQ(edge, 1);
  const auto [left, right, top, bottom] = edges.Along({16, 8, 22, 20});
  EXPECT_LT(left, 0.5);
  EXPECT_EQ(right, 1);
  EXPECT_EQ(bottom, 0);
  for (const float edge : edges.Along({0, 0, 40, 30})) EXPECT_EQ(edge, 0);  // beyond the raster
}

TEST_F(WallEdgesTest, HalfAWindowBecomesAWholeOne) {
  const WallEdges edges(sweep_);
  const CellRectangle part = {2, 0, 34, 30};
  const cv::Mat nothing(30, 32, CV_32F, cv::Scalar(0));
  EXPECT_TRUE(edges.Snap({16, 9, 21, 20}, part, nothing, 8) == (CellRectangle{10, 8, 22, 24}));
  // No farther than it may.
  EXPECT_GE(edges.Snap({16, 9, 21, 20}, part, nothing, 2).left, 14);
}

TEST_F(WallEdgesTest, EvidenceKeepsItFromTheNextEdge) {
  const WallEdges edges(sweep_);
  const CellRectangle part = {2, 0, 34, 30};
  cv::Mat against(30, 32, CV_32F, cv::Scalar(0));
  against(cv::Rect(8, 0, 6, 30)).setTo(-1);  // columns 10 to 15: there, photos see the wall
  EXPECT_EQ(edges.Snap({16, 9, 21, 20}, part, against, 8).left, 16);
}

// The blurred bar is no edge to go to, and nothing else is there: but another window ends there.
TEST_F(WallEdgesTest, SidesGoToTheLinesOfOtherWindows) {
  WallEdges edges(sweep_);
  const CellRectangle part = {24, 0, 40, 30};
  const cv::Mat nothing(30, 16, CV_32F, cv::Scalar(0));
  EXPECT_TRUE(edges.Snap({28, 10, 36, 22}, part, nothing, 4) == (CellRectangle{28, 10, 36, 22}));
  edges.Remember({10, 8, 22, 24});
  EXPECT_TRUE(edges.Snap({28, 10, 36, 22}, part, nothing, 4) == (CellRectangle{28, 8, 36, 24}));
  EXPECT_EQ(edges.Snap({28, 10, 36, 22}, part, nothing, 1).top, 10);
}

TEST_F(WallEdgesTest, WhereNoPhotoShowsTheWallThereAreNone) {
  for (int y = 0; y < 30; ++y) Grey(9, y) = -1;
  EXPECT_EQ(WallEdges(sweep_).Along({10, 8, 22, 24})[0], 0);
}

}  // namespace
}  // namespace stucco
