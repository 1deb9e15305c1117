// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/output/atlas.h"

#include <gtest/gtest.h>

#include <random>

namespace stucco {
namespace {

Image Plain(ImageSize size, uint8_t shade) {
  Image image{size.width_px, size.height_px, 3, {}};
  image.data.assign(static_cast<size_t>(size.width_px) * size.height_px * 3, shade);
  return image;
}

TEST(Atlas, PicturesAndTheirGuttersLieApart) {
  std::mt19937 random(5);
  std::vector<ImageSize> pictures;
  for (int i = 0; i < 60; ++i) {
    pictures.push_back({1 + static_cast<int>(random() % 90), 1 + static_cast<int>(random() % 90)});
  }
  const AtlasLayout layout = PackAtlas(pictures, 256);
  EXPECT_LE(layout.size.width_px, 256);
  std::vector<int> taken(static_cast<size_t>(layout.size.width_px) * layout.size.height_px, -1);
  double texels = 0;
  for (size_t i = 0; i < pictures.size(); ++i) {
    for (int y = -kAtlasGutter_px; y < pictures[i].height_px + kAtlasGutter_px; ++y) {
      for (int x = -kAtlasGutter_px; x < pictures[i].width_px + kAtlasGutter_px; ++x) {
        const Eigen::Vector2i at = layout.places[i] + Eigen::Vector2i(x, y);
        ASSERT_GE(at.minCoeff(), 0);
        ASSERT_LT(at.x(), layout.size.width_px);
        ASSERT_LT(at.y(), layout.size.height_px);
        int& owner = taken[static_cast<size_t>(at.y()) * layout.size.width_px + at.x()];
        ASSERT_EQ(owner, -1) << i << " covers " << owner;
        owner = static_cast<int>(i);
        ++texels;
      }
    }
  }
  EXPECT_GT(texels, 0.7 * static_cast<double>(taken.size()));
}

TEST(Atlas, OnePictureFillsTheWidth) {
  const AtlasLayout layout =
      PackAtlas(std::vector<ImageSize>{{256 - 2 * kAtlasGutter_px, 3000}}, 256);
  EXPECT_EQ(layout.size.width_px, 256);
  EXPECT_EQ(layout.size.height_px, 3000 + 2 * kAtlasGutter_px);
}

TEST(Atlas, NothingIsOneTexel) {
  EXPECT_EQ(PackAtlas({}, 64).size.width_px, 1);
}

TEST(Atlas, GuttersRepeatTheBorder) {
  Image picture = Plain({2, 2}, 0);
  picture.Pixel(0, 0)[0] = 11;
  picture.Pixel(1, 0)[0] = 22;
  picture.Pixel(0, 1)[0] = 33;
  picture.Pixel(1, 1)[0] = 44;
  Image atlas = Plain({20, 20}, 99);
  PaintInAtlas(picture, {8, 8}, atlas);
  EXPECT_EQ(atlas.Pixel(8, 8)[0], 11);
  EXPECT_EQ(atlas.Pixel(9, 9)[0], 44);
  EXPECT_EQ(atlas.Pixel(4, 4)[0], 11);
  EXPECT_EQ(atlas.Pixel(13, 8)[0], 22);
  EXPECT_EQ(atlas.Pixel(8, 13)[0], 33);
  EXPECT_EQ(atlas.Pixel(13, 13)[0], 44);
  EXPECT_EQ(atlas.Pixel(14, 9)[0], 99);
  EXPECT_EQ(atlas.Pixel(3, 9)[0], 99);
}

TEST(AtlasDeathTest, NeedsPicturesThatFit) {
  EXPECT_DEATH(PackAtlas(std::vector<ImageSize>{{60, 4}}, 64), "width_px");
}

}  // namespace
}  // namespace stucco
