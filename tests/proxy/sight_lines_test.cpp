// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/map/sight_lines.h"

#include <gtest/gtest.h>

namespace stucco {
namespace {

constexpr Tolerances kTolerances{.spacing = 0.1};

// A roof at 10 m over y < 4, whose wall of y = 4 photos from the north have seen, over x from 0 to
// 10, at heights up to 9 m.
class SightLines : public testing::Test {
 protected:
  SightLines() {
    raster_.cell = 0.25;
    raster_.width = raster_.height = 40;
    AddRoof(0, 4, 10);
    Plane& roof = evidence_.planes.emplace_back();
    roof.normal = Eigen::Vector3d::UnitZ();
    roof.offset = 10;
    roof.area = 40;
    for (double x = 0.05; x < 10; x += 0.1) {
      for (double z = 1; z < 9; z += 0.5) {
        evidence_.sights.push_back({{x, 4, z}, {x, 30, z + 6}});
      }
    }
  }

  void AddRoof(double from_y, double to_y, double z) {
    for (double x = 0.05; x < 10; x += 0.1) {
      for (double y = from_y + 0.05; y < to_y; y += 0.1) {
        evidence_.samples.positions.emplace_back(x, y, z);
      }
    }
  }
  bool IsThrough(double x, double y) const {
    return SeenThrough(evidence_, raster_, kTolerances)[raster_.IndexAt({x, y})] != 0;
  }

  RoofEvidence evidence_;
  PlaneRaster raster_;
};

TEST_F(SightLines, ShowThatNothingStandsBeforeAWall) {
  EXPECT_TRUE(IsThrough(5, 5));
  EXPECT_TRUE(IsThrough(5, 8));
  EXPECT_FALSE(IsThrough(5, 3));
}

TEST_F(SightLines, PassStraysAndEaves) {
  AddRoof(4, 4.7, 10);
  evidence_.samples.positions.emplace_back(5, 7, 10);
  EXPECT_FALSE(IsThrough(5, 4.4));
  EXPECT_TRUE(IsThrough(5, 5.1));
  EXPECT_TRUE(IsThrough(5, 7));
}

TEST_F(SightLines, PassBelowBalconiesAndAboveSheds) {
  AddRoof(4, 6, 8);  // a balcony, below which the wall goes on
  EXPECT_TRUE(IsThrough(5, 5));
  evidence_.samples.positions.clear();
  AddRoof(0, 4, 10);
  AddRoof(4, 6, 0.9);  // a shed
  EXPECT_FALSE(IsThrough(5, 5));
  EXPECT_TRUE(IsThrough(5, 7));
}

// A mirror image of a wall stands behind panes, below a roof.
TEST_F(SightLines, ThatRoofsBlockTellNothing) {
  AddRoof(4, 8, 10);
  EXPECT_FALSE(IsThrough(5, 5));
  EXPECT_FALSE(IsThrough(5, 9));
}

TEST_F(SightLines, TellNothingOfWhatHasNoRoof) {
  evidence_.planes.clear();
  EXPECT_FALSE(IsThrough(5, 5));
}

}  // namespace
}  // namespace stucco
