// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/output/atlas.h"

#include <gtest/gtest.h>

#include <algorithm>
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
  picture.Pixel(0, 0)[0] = 12;
  picture.Pixel(1, 0)[0] = 22;
  picture.Pixel(0, 1)[0] = 32;
  picture.Pixel(1, 1)[0] = 42;
  const Image atlas = PaintAtlas({{20, 20}, {{8, 8}}}, [&](size_t) { return picture; });
  EXPECT_EQ(atlas.Pixel(8, 8)[0], 12);
  EXPECT_EQ(atlas.Pixel(9, 9)[0], 42);
  EXPECT_EQ(atlas.Pixel(4, 4)[0], 12);
  EXPECT_EQ(atlas.Pixel(13, 8)[0], 22);
  EXPECT_EQ(atlas.Pixel(8, 13)[0], 32);
  EXPECT_EQ(atlas.Pixel(13, 13)[0], 42);
  EXPECT_EQ(atlas.Pixel(14, 9)[0], 27);  // the mean
  EXPECT_EQ(atlas.Pixel(3, 9)[0], 27);
}

TEST(Atlas, AsManyAsItTakesAndNoneTooLarge) {
  std::mt19937 random(7);
  std::vector<ImageSize> pictures;
  double texels = 0;
  for (int i = 0; i < 200; ++i) {
    pictures.push_back({1 + static_cast<int>(random() % 56), 1 + static_cast<int>(random() % 56)});
    texels += (pictures.back().width_px + 2.0 * kAtlasGutter_px) *
              (pictures.back().height_px + 2 * kAtlasGutter_px);
  }
  pictures.push_back({128 - 2 * kAtlasGutter_px, 128 - 2 * kAtlasGutter_px});  // one for itself
  const std::vector<PackedAtlas> atlases = PackAtlases(pictures, 128);
  EXPECT_LT(static_cast<double>(atlases.size()), 1 + 1.3 * texels / (128 * 128) + 1);
  std::vector<int> times(pictures.size(), 0);
  for (const auto& [packed, layout] : atlases) {
    ASSERT_EQ(packed.size(), layout.places.size());
    EXPECT_LE(std::max(layout.size.width_px, layout.size.height_px), 128);
    std::vector<uint8_t> taken(128 * 128, 0);
    for (size_t k = 0; k < packed.size(); ++k) {
      ++times[packed[k]];
      const ImageSize& size = pictures[packed[k]];
      for (int y = -kAtlasGutter_px; y < size.height_px + kAtlasGutter_px; ++y) {
        for (int x = -kAtlasGutter_px; x < size.width_px + kAtlasGutter_px; ++x) {
          const Eigen::Vector2i at = layout.places[k] + Eigen::Vector2i(x, y);
          ASSERT_GE(at.minCoeff(), 0);
          ASSERT_LT(at.x(), layout.size.width_px);
          ASSERT_LT(at.y(), layout.size.height_px);
          ASSERT_EQ(taken[static_cast<size_t>(at.y()) * 128 + at.x()]++, 0);
        }
      }
    }
  }
  EXPECT_EQ(std::ranges::count(times, 1), static_cast<long>(pictures.size()));
}

TEST(Atlas, CoordinatesOfAPictureLeadIntoIt) {
  const Eigen::Vector2f at = InAtlas({0.5f, 1}, {40, 30}, {4, 10}, {80, 60});
  EXPECT_FLOAT_EQ(at.x(), 24.0f / 80);
  EXPECT_FLOAT_EQ(at.y(), 40.0f / 60);
}

TEST(AtlasDeathTest, NeedsPicturesThatFit) {
  EXPECT_DEATH(PackAtlas(std::vector<ImageSize>{{60, 4}}, 64), "width_px");
}

}  // namespace
}  // namespace stucco
