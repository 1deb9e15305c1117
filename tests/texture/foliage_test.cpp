// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/selection/foliage.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <random>
#include <vector>

namespace stucco {
namespace {

constexpr int kSide = 40;
constexpr double kBefore = 5;  // texels that leaves are at least before the wall
constexpr int kCrown = 14;     // the upper left corner, so many texels wide and high

using Rgb = std::array<float, 3>;

TexelGrid Raster() {
  TexelGrid raster;
  raster.width = kSide;
  raster.height = kSide;
  return raster;
}

size_t At(int x, int y) {
  return static_cast<size_t>(y) * kSide + x;
}

// A grey wall with what covers its corner: `colour` in shades between `darkest` and 1, drawn anew
// from `seed`.
RasterPicture Wall(Rgb colour, float darkest, uint32_t seed, int crown = kCrown) {
  RasterPicture picture;
  picture.sight.assign(kSide * kSide, Sight::kFree);
  picture.cost.assign(kSide * kSide, 0.1f);
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> shade(darkest, 1);
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      const bool covered = x < crown && y < crown;
      const float bright = covered ? shade(random) : 1;
      for (const float value : covered ? colour : Rgb{120, 118, 115}) {
        picture.rgb.push_back(bright * value);
      }
    }
  }
  return picture;
}

constexpr Rgb kLeaf = {110, 150, 40};

std::vector<RasterPicture> Dropped(std::vector<RasterPicture> pictures) {
  DropFoliage({Raster(), std::vector<uint16_t>(kSide * kSide, 1), 1}, kBefore, pictures);
  return pictures;
}

int Unseen(const RasterPicture& picture) {
  return static_cast<int>(std::ranges::count(picture.sight, Sight::kNot));
}

TEST(DropFoliage, AnotherPhotoSeesPastThem) {
  const auto pictures = Dropped({Wall(kLeaf, 0.3f, 1), Wall(kLeaf, 0.3f, 1, 0)});
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      if (x < kCrown && y < kCrown) {
        EXPECT_EQ(pictures[0].sight[At(x, y)], Sight::kNot) << x << ' ' << y;
      } else if (x > kCrown + 3 || y > kCrown + 3) {
        EXPECT_EQ(pictures[0].sight[At(x, y)], Sight::kFree) << x << ' ' << y;
      }
    }
  }
  EXPECT_EQ(Unseen(pictures[1]), 0);
}

TEST(DropFoliage, WhatNobodyElseSeesStays) {
  EXPECT_EQ(Unseen(Dropped({Wall(kLeaf, 0.3f, 1)})[0]), 0);
  auto pictures = std::vector<RasterPicture>{Wall(kLeaf, 0.3f, 1), Wall(kLeaf, 0.3f, 1, 0)};
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      if (x < 30 && y < 30) pictures[1].sight[At(x, y)] = Sight::kNot;
    }
  }
  EXPECT_EQ(Unseen(Dropped(pictures)[0]), 0);
}

TEST(DropFoliage, WhatTheCloudHasInFrontNeedsNoOtherPhoto) {
  auto pictures = std::vector<RasterPicture>{Wall(kLeaf, 0.3f, 1), Wall({120, 80, 50}, 0.3f, 1)};
  for (RasterPicture& picture : pictures) {
    for (int y = 0; y < kCrown; ++y) {
      for (int x = 0; x < kCrown; ++x) picture.sight[At(x, y)] = Sight::kBehind;
    }
  }
  pictures = Dropped(pictures);
  EXPECT_EQ(pictures[0].sight[At(5, 5)], Sight::kNot);
  EXPECT_EQ(pictures[1].sight[At(5, 5)], Sight::kBehind);  // a bay, a balcony: better than nothing
}

TEST(DropFoliage, LeavesThatDifferFromPhotoToPhotoStandBeforeTheWall) {
  const auto pictures = Dropped({Wall(kLeaf, 0.3f, 1), Wall(kLeaf, 0.3f, 2)});
  EXPECT_EQ(pictures[0].sight[At(5, 5)], Sight::kNot);
  EXPECT_EQ(pictures[1].sight[At(5, 5)], Sight::kNot);
}

// What is dark amid leaves is dropped with them, and what they enclose; the wall beside them is
// not.
TEST(DropFoliage, CrownsAreWhole) {
  std::vector<RasterPicture> pictures = {Wall(kLeaf, 0.3f, 1, 30), Wall(kLeaf, 0.3f, 1, 0)};
  const auto darken = [&](int from, int to) {
    for (int y = from; y < to; ++y) {
      for (int x = from; x < to; ++x) std::fill_n(&pictures[0].rgb[3 * At(x, y)], 3, 4.0f);
    }
  };
  darken(6, 21);
  darken(2, 4);
  pictures.push_back(pictures[1]);
  const auto left = Dropped(pictures);
  EXPECT_EQ(left[0].sight[At(13, 13)], Sight::kNot);
  EXPECT_EQ(left[0].sight[At(2, 2)], Sight::kNot);
  EXPECT_EQ(left[0].sight[At(35, 10)], Sight::kFree);
  EXPECT_EQ(left[0].sight[At(10, 35)], Sight::kFree);
  EXPECT_EQ(Unseen(left[1]), 0);
}

// A wall whose upper left corner lies back, so many texels wide and high.
std::shared_ptr<const Relief> Pane(int side) {
  auto pane = std::make_shared<Relief>();
  pane->width = pane->height = kSide;
  pane->heights.assign(kSide * kSide, 0.0f);
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) pane->heights[At(x, y)] = -0.15f;
  }
  return pane;
}

TEST(DropFoliage, ATreeInAPaneIsNotBeforeIt) {
  const std::vector<uint16_t> inside(kSide * kSide, 1);
  std::vector<RasterPicture> pictures = {Wall(kLeaf, 0.3f, 1), Wall(kLeaf, 0.3f, 1, 0)};
  TexelGrid raster = Raster();
  raster.relief = Pane(kCrown);
  DropFoliage({raster, inside, 1}, kBefore, pictures);
  EXPECT_EQ(Unseen(pictures[0]), 0);
  raster.relief = Pane(kCrown - 3);  // leaves that hang over its edge do stand before it
  DropFoliage({raster, inside, 1}, kBefore, pictures);
  EXPECT_EQ(pictures[0].sight[At(5, 5)], Sight::kNot);
}

TEST(DropFoliage, WhatGrowsOnTheWallStays) {
  for (const RasterPicture& picture : Dropped({Wall(kLeaf, 0.3f, 1), Wall(kLeaf, 0.3f, 1)})) {
    EXPECT_EQ(Unseen(picture), 0);
  }
}

TEST(DropFoliage, APhotoFromTheSamePlaceProvesNothing) {
  std::vector<RasterPicture> twice = {Wall(kLeaf, 0.3f, 1), Wall(kLeaf, 0.3f, 1)};
  twice[0].camera = {20, 20, 100};
  twice[1].camera = {22, 20, 100};
  twice.push_back(Wall(kLeaf, 0.3f, 1, 0));
  EXPECT_EQ(Dropped(twice)[0].sight[At(5, 5)], Sight::kNot);
  twice[1].camera = {80, 20, 100};
  EXPECT_EQ(Dropped(twice)[0].sight[At(5, 5)], Sight::kFree);
}

TEST(DropFoliage, GreenPaintAndRestlessThingsOfOtherColoursStay) {
  const RasterPicture bare = Wall(kLeaf, 1, 1, 0);
  EXPECT_EQ(Unseen(Dropped({Wall(kLeaf, 1, 1), bare})[0]), 0);
  EXPECT_EQ(Unseen(Dropped({Wall({200, 170, 60}, 0.3f, 1), bare})[0]), 0);
  EXPECT_EQ(Unseen(Dropped({Wall({90, 95, 100}, 0.3f, 1), bare})[0]), 0);
}

TEST(DropFoliage, AWallThatIsGreenAllOverStays) {
  const RasterPicture other = Wall(kLeaf, 0.3f, 2, kSide);  // that does not register with it
  EXPECT_EQ(Unseen(Dropped({Wall(kLeaf, 0.3f, 1, kSide), other})[0]), 0);
}

// A bush before the right third of a wall of bricks.
TEST(LeafTexels, AreGreenAndRestless) {
  constexpr int kWidth = 240, kHeight = 160;
  Image picture{kWidth, kHeight, 3, std::vector<uint8_t>(3 * kWidth * kHeight)};
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const int shade = (x / 8 * 37 + y / 8 * 61) % 5;  // another one in each cell
      uint8_t* rgb = picture.Pixel(x, y);
      const bool bush = x >= 160;
      rgb[0] = static_cast<uint8_t>(bush ? 30 + 12 * shade : 150 + 8 * shade);
      rgb[1] = static_cast<uint8_t>(bush ? 60 + 25 * shade : 90 + 5 * shade);
      rgb[2] = static_cast<uint8_t>(bush ? 20 + 8 * shade : 80 + 5 * shade);
    }
  }
  const std::vector<uint8_t> painted(size_t{kWidth} * kHeight, 1);
  const auto at = [&](const std::vector<uint8_t>& leaves, int x, int y) {
    return static_cast<int>(leaves[static_cast<size_t>(y) * kWidth + x]);
  };
  const auto leaves = LeafTexels(picture, painted);
  EXPECT_EQ(at(leaves, 60, 80), 0);
  EXPECT_EQ(at(leaves, 210, 80), 1);
}

}  // namespace
}  // namespace stucco
