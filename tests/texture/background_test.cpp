// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/selection/background.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

namespace stucco {
namespace {

constexpr int kSide = 20;

TexelGrid Raster() {
  TexelGrid raster;
  raster.width = kSide;
  raster.height = kSide;
  return raster;
}

constexpr int kWallRows = 10;  // the lower half has points

using Rgb = std::array<float, 3>;

// The wall below, something else above.
std::vector<float> Above(Rgb above, Rgb wall = {150, 110, 80}) {
  std::vector<float> rgb;
  for (int i = 0; i < kSide * kSide; ++i) {
    const Rgb& colour = i / kSide < kSide - kWallRows ? above : wall;
    rgb.insert(rgb.end(), colour.begin(), colour.end());
  }
  return rgb;
}

// Sight of the upper left texel.
Sight Marked(const std::vector<float>& rgb, bool no_points = true, bool skyward = true) {
  SkyClues clues;
  clues.no_points.assign(kSide * kSide, 0);
  std::fill_n(clues.no_points.begin(), kSide * (kSide - kWallRows), no_points);
  clues.skyward.assign(kSide * kSide, skyward);
  std::vector<Sight> sight(kSide * kSide, Sight::kFree);
  MarkSky(Raster(), clues, rgb, sight);
  return sight[0];
}

TEST(MarkSky, TakesWhatIsBrightBlueAndWithoutPoints) {
  EXPECT_EQ(Marked(Above({170, 200, 250})), Sight::kBeyond);
  EXPECT_EQ(Marked(Above({255, 255, 255})), Sight::kBeyond);
  EXPECT_EQ(Marked(Above({170, 200, 250}), false), Sight::kFree);
  EXPECT_EQ(Marked(Above({230, 220, 200})), Sight::kFree);  // sunlit plaster
  EXPECT_EQ(Marked(Above({60, 70, 90})), Sight::kFree);     // slate
}

TEST(MarkSky, LeavesWhiteRoofsSeenFromAboveAlone) {
  EXPECT_EQ(Marked(Above({255, 255, 255}), true, false), Sight::kFree);
}

TEST(FindSkyward, IsFalseWhereRaysGoDownClearly) {
  const Eigen::Vector3d up(0, 0, 1);
  TexelGrid roof = Raster();  // level, 20 x 20 m
  roof.v_axis = -Eigen::Vector3d::UnitY();
  const auto from_above = FindSkyward(roof, {10, -10, 30}, up);
  EXPECT_EQ(std::count(from_above.begin(), from_above.end(), 1), 0);

  TexelGrid wall = Raster();  // from z = 20 down to 0
  wall.origin.z() = 20;
  wall.v_axis = -up;
  const auto level = FindSkyward(wall, {10, -30, 10}, up);
  for (int row = 0; row < kSide; ++row) {
    EXPECT_EQ(level[row * kSide + 10], row <= 10) << row;  // row 10 is 0.5 m down in 30 m
  }
  const auto turned = FindSkyward(wall, {10, -30, 10}, -up);
  EXPECT_EQ(turned[0], 0);
}

TEST(MarkSky, LeavesWallsAloneThatHaveItsColour) {
  EXPECT_EQ(Marked(Above({150, 160, 200}, {140, 150, 190})), Sight::kFree);
}

TEST(MarkSky, LeavesTextureAlone) {
  std::vector<float> rgb = Above({170, 200, 250});
  for (size_t i = 0; i < rgb.size(); i += 6) rgb[i] = rgb[i + 1] = rgb[i + 2] = 100;
  EXPECT_EQ(Marked(rgb), Sight::kFree);
}

class DropBackgroundTest : public ::testing::Test {
 protected:
  // Marks a rectangle as beyond and drops; whether its first texel lost its owner.
  bool Drops(int x0, int y0, int x1, int y1) {
    RasterPicture picture;
    picture.sight.assign(kSide * kSide, Sight::kFree);
    for (int i = 0; i < kSide * kSide; ++i) {  // a checkered wall
      picture.rgb.insert(picture.rgb.end(), 3, (i / kSide + i % kSide) % 2 == 0 ? 60.0f : 120.0f);
    }
    for (int y = y0; y < y1; ++y) {
      for (int x = x0; x < x1; ++x) {
        picture.sight[y * kSide + x] = Sight::kBeyond;
        std::fill_n(&picture.rgb[3 * (y * kSide + x)], 3, 240.0f);
      }
    }
    std::vector<int> owner(kSide * kSide, 0);
    const std::vector<uint16_t> inside(kSide * kSide, 4);
    DropBackground(Raster(), inside, std::vector<RasterPicture>{picture}, owner);
    for (int i = 0; i < kSide * kSide; ++i) {
      const bool far = i % kSide < x0 - 1 || i % kSide > x1 || i / kSide < y0 - 1 || i / kSide > y1;
      if (far) {
        EXPECT_EQ(owner[i], 0);
      }
    }
    return owner[y0 * kSide + x0] < 0;
  }
};

TEST_F(DropBackgroundTest, TakesRegionsAtTheSidesAndTheTop) {
  EXPECT_TRUE(Drops(0, 5, 2, 15));
  EXPECT_TRUE(Drops(18, 5, 20, 15));
  EXPECT_TRUE(Drops(5, 0, 15, 2));
}

TEST(DropBackground, GrowsIntoTheSkyAndTakesARim) {
  RasterPicture picture;
  picture.sight.assign(kSide * kSide, Sight::kFree);
  for (int i = 0; i < kSide * kSide; ++i) {
    const int x = i % kSide;
    picture.rgb.insert(picture.rgb.end(), 3, x < 3 ? 240.0f : 100.0f);
    if (x < 2) picture.sight[i] = Sight::kBeyond;
  }
  std::vector<int> owner(kSide * kSide, 0);
  DropBackground(Raster(), std::vector<uint16_t>(kSide * kSide, 4),
                 std::vector<RasterPicture>{picture}, owner);
  for (int i = 0; i < kSide * kSide; ++i) EXPECT_EQ(owner[i], i % kSide < 4 ? -1 : 0);
}

TEST_F(DropBackgroundTest, LeavesArcadesAndWindows) {
  EXPECT_FALSE(Drops(5, 15, 10, 20));
  EXPECT_FALSE(Drops(5, 5, 10, 10));
}

TEST_F(DropBackgroundTest, DoesNotTakeHalfAFacet) {
  EXPECT_FALSE(Drops(0, 0, 10, 20));
}

}  // namespace
}  // namespace stucco
