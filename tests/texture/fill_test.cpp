// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/painting/fill.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/texture/synthetic.h"
#include "texture/painting/patch_fill.h"

namespace stucco {
namespace {

constexpr int kColumns = 150;
constexpr int kRows = 110;

// Bricks: periodic, so that what is missing can be copied from elsewhere.
Image Bricks() {
  Image image;
  image.width_px = kColumns;
  image.height_px = kRows;
  for (int y = 0; y < kRows; ++y) {
    for (int x = 0; x < kColumns; ++x) {
      const int shifted = x + (y / 10 % 2) * 8;
      const bool joint = y % 10 < 2 || shifted % 16 < 2;
      for (int k = 0; k < 3; ++k) image.data.push_back(joint ? 200 : 90 + 20 * k);
    }
  }
  return image;
}

std::vector<uint8_t> Square(int x0, int y0, int side) {
  std::vector<uint8_t> mask(kColumns * kRows, 0);
  for (int y = y0; y < y0 + side; ++y) {
    for (int x = x0; x < x0 + side; ++x) mask[y * kColumns + x] = 1;
  }
  return mask;
}

std::vector<uint8_t> Inverse(std::vector<uint8_t> mask) {
  for (uint8_t& m : mask) m = !m;
  return mask;
}

TEST(FillSmoothly, KeepsKnownTexelsAndAPlainColour) {
  std::vector<float> rgb(3 * kColumns * kRows, 0);
  std::vector<uint8_t> known(kColumns * kRows, 0);
  for (int i = 0; i < kColumns * kRows; i += 97) {
    known[i] = 1;
    rgb[3 * i] = 50;
    rgb[3 * i + 1] = 60;
    rgb[3 * i + 2] = 70;
  }
  FillSmoothly(rgb, known, kColumns, kRows);
  for (int i = 0; i < kColumns * kRows; ++i) {
    EXPECT_NEAR(rgb[3 * i], 50, 1e-3);
    EXPECT_NEAR(rgb[3 * i + 2], 70, 1e-3);
  }
}

TEST(FillSmoothly, GoesBetweenItsNeighbours) {
  std::vector<float> rgb(3 * 64, 0);
  std::vector<uint8_t> known(64, 0);
  known[0] = known[63] = 1;
  rgb[3 * 63] = 100;
  FillSmoothly(rgb, known, 64, 1);
  EXPECT_EQ(rgb[0], 0);
  EXPECT_EQ(rgb[3 * 63], 100);
  EXPECT_LT(rgb[3 * 8], 30);
  EXPECT_GT(rgb[3 * 56], 70);
  for (int x = 1; x < 64; ++x) EXPECT_GE(rgb[3 * x], rgb[3 * (x - 1)] - 1);
}

TEST(FillSmoothly, DoesNothingWhenNothingIsKnown) {
  std::vector<float> rgb(3 * 16, 0);
  FillSmoothly(rgb, std::vector<uint8_t>(16, 0), 4, 4);
  EXPECT_EQ(rgb, std::vector<float>(48, 0));
}

TEST(FillPictureSmoothly, ChangesOnlyTheUnknown) {
  const Image truth = Bricks();
  Image picture = truth;
  const auto hole = Square(60, 40, 24);
  for (int i = 0; i < kColumns * kRows; ++i) {
    if (hole[i]) picture.data[3 * i] = picture.data[3 * i + 1] = picture.data[3 * i + 2] = 0;
  }
  FillPictureSmoothly(picture, Inverse(hole));
  for (int i = 0; i < kColumns * kRows; ++i) {
    if (hole[i]) {
      EXPECT_GT(picture.data[3 * i], 80);
    } else {
      EXPECT_EQ(picture.data[3 * i], truth.data[3 * i]);
    }
  }
}

TEST(FillWithPatches, ContinuesAPattern) {
  const Image truth = Bricks();
  const auto hole = Square(60, 40, 24);
  Image picture = truth;
  FillPictureSmoothly(picture, Inverse(hole));
  const double smooth = test::Psnr(picture, truth, hole);
  FillWithPatches(picture, hole, Inverse(hole), 512, 1);
  const double patched = test::Psnr(picture, truth, hole);
  EXPECT_GT(patched, smooth + 4);
  EXPECT_GT(patched, 20);
  EXPECT_GT(test::Psnr(picture, truth, Inverse(hole)), 90);
}

// Shaded bricks above a plain plinth, a third of them missing down to the edge of the picture: the
// hole is as restless as the wall beside it, and the plinth goes on.
TEST(FillWithPatches, LargeHolesAreNoSmoothPatches) {
  Image truth = Bricks();
  std::mt19937 random(3);
  for (int y = 0; y < kRows; ++y) {
    for (int x = 0; x < kColumns; ++x) {
      const int brick = (x + (y / 10 % 2) * 8) / 16 * 31 + y / 10 * 17;
      for (int k = 0; k < 3; ++k) {
        uint8_t& value = truth.Pixel(x, y)[k];
        value = y >= 95 ? 160 : static_cast<uint8_t>(value - 60 + brick * 7 % 60 + random() % 8);
      }
    }
  }
  std::vector<uint8_t> hole(kColumns * kRows, 0);
  for (int y = 25; y < kRows; ++y) {
    for (int x = 50; x < 100; ++x) hole[y * kColumns + x] = 1;
  }
  Image picture = truth;
  FillPictureSmoothly(picture, Inverse(hole));
  FillWithPatches(picture, hole, Inverse(hole), 512, 1);
  const auto spread = [](const Image& image, int left) {
    double sum = 0, squares = 0;
    for (int y = 30; y < 90; ++y) {
      for (int x = left; x < left + 40; ++x) {
        const double value = image.Pixel(x, y)[1];
        sum += value;
        squares += value * value;
      }
    }
    return std::sqrt(squares / 2400 - sum * sum / 2400 / 2400);
  };
  EXPECT_GT(spread(picture, 55), 0.8 * spread(truth, 5));
  for (int y = 100; y < kRows; ++y) {
    for (int x = 50; x < 100; ++x) EXPECT_NEAR(picture.Pixel(x, y)[1], 160, 12) << x << ' ' << y;
  }
}

TEST(FillWithPatches, IsTheSameEveryTime) {
  const auto hole = Square(20, 30, 30);
  Image first = Bricks();
  Image second = Bricks();
  FillWithPatches(first, hole, Inverse(hole), 100, 3);
  FillWithPatches(second, hole, Inverse(hole), 100, 3);
  EXPECT_EQ(first.data, second.data);
}

TEST(FillWithPatches, NeedsSomethingToCopy) {
  Image picture = Bricks();
  const Image before = picture;
  const auto hole = Square(0, 0, 50);
  FillWithPatches(picture, hole, Square(60, 60, 6), 512, 1);
  EXPECT_EQ(picture.data, before.data);
}

}  // namespace
}  // namespace stucco
