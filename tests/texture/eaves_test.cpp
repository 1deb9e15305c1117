// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/selection/eaves.h"

#include <gtest/gtest.h>

#include <vector>

namespace stucco {
namespace {

constexpr int kGround_px = 40;

// Ground beside a house in columns 0 to 3, whose eaves hide the next three from the first of two
// pictures, which owns all of it, as a pipe in columns 12 and 13 and a crown of ten by ten do. The
// second shows rows from 20 on, freely.
class ClearEavesTest : public testing::Test {
 protected:
  ClearEavesTest() {
    raster_.width = kGround_px;
    raster_.height = kGround_px;
    for (RasterPicture& picture : pictures_) {
      picture.sight.assign(kGround_px * kGround_px, Sight::kFree);
      picture.cost.assign(kGround_px * kGround_px, 0.5f);
    }
    for (int y = 0; y < kGround_px; ++y) {
      for (int x = 0; x < kGround_px; ++x) {
        if (x < 4) owner_[At(x, y)] = -1;
        const bool crown = x >= 20 && x < 30 && y >= 15 && y < 25;
        const bool hidden = (x >= 4 && x < 7) || x == 12 || x == 13 || crown;
        if (hidden) pictures_[0].sight[At(x, y)] = Sight::kBehind;
        if (y < 20) pictures_[1].sight[At(x, y)] = Sight::kNot;
      }
    }
  }
  static size_t At(int x, int y) { return static_cast<size_t>(y) * kGround_px + x; }
  void Clear(double half_width) { ClearEaves(raster_, pictures_, half_width, owner_); }

  TexelGrid raster_;
  std::vector<RasterPicture> pictures_ = std::vector<RasterPicture>(2);
  std::vector<int> owner_ = std::vector<int>(kGround_px * kGround_px, 0);
};

TEST_F(ClearEavesTest, PaintsWhatAnyPictureShowsAndLeavesTheRestToBeFilled) {
  Clear(2);
  EXPECT_EQ(owner_[At(4, 30)], 1);
  EXPECT_EQ(owner_[At(6, 39)], 1);
  EXPECT_EQ(owner_[At(4, 10)], -1);
  EXPECT_EQ(owner_[At(6, 0)], -1);
  EXPECT_EQ(owner_[At(7, 20)], 0);
}

TEST_F(ClearEavesTest, WhatStandsFreeStaysWhole) {
  Clear(100);
  EXPECT_EQ(owner_[At(12, 30)], 0);
  EXPECT_EQ(owner_[At(25, 15)], 0);
  EXPECT_EQ(owner_[At(25, 24)], 0);
}

TEST_F(ClearEavesTest, WhatIsWideStays) {
  Clear(1.5);
  EXPECT_EQ(owner_[At(4, 30)], 0);
  EXPECT_EQ(owner_[At(6, 10)], 0);
}

}  // namespace
}  // namespace stucco
