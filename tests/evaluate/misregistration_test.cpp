// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "evaluate/picture/misregistration.h"

#include <gtest/gtest.h>

#include <cmath>

#include "survey/error.h"
#include "tests/evaluate/made_pictures.h"

namespace stucco::evaluate {
namespace {

TEST(Misregistration, IsZeroForEqualPictures) {
  const Image picture = Waves(120, 100);
  EXPECT_NEAR(Misregistration({picture, picture, {}}), 0, 1e-6);
}

TEST(Misregistration, IsTheLengthOfAKnownShift) {
  const Image truth = Waves(160, 140);
  for (const auto& [dx, dy] : {std::pair{0.25, 0.0}, {0.6, -0.8}, {-3.0, 4.0}, {12.0, 5.0}}) {
    EXPECT_NEAR(Misregistration({truth, Waves(160, 140, dx, dy), {}}), std::hypot(dx, dy), 0.03)
        << dx << " " << dy;
  }
}

TEST(Misregistration, LargeShiftsAreNotTakenForSmallOnes) {
  const Image truth = Waves(600, 400);
  for (const double shift : {16.0, 20.0, 30.0, 40.0, 70.0}) {
    EXPECT_NEAR(Misregistration({truth, Waves(600, 400, shift, -shift / 3), {}}),
                std::hypot(shift, shift / 3), 0.1)
        << shift;
  }
}

TEST(Misregistration, OtherContentSaysNothing) {
  const Image truth = Noisy(Plain(300, 200, 120, 120, 120), 40);
  Image other = Plain(300, 200, 120, 120, 120);
  for (int y = 0; y < 200; ++y) {
    for (int x = 0; x < 300; ++x) {
      if ((x * 7 + y * 13 + x * y / 5) % 23 < 9) {
        std::fill(other.Pixel(x, y), other.Pixel(x, y) + 3, uint8_t{200});
      }
    }
  }
  EXPECT_TRUE(std::isnan(Misregistration({truth, other, {}})));
}

TEST(Misregistration, DoesNotMindLightNoiseAndBlur) {
  const Image truth = Waves(160, 140);
  const Image moved = Waves(160, 140, 0.6, 0.8);
  const Image darker = Changed(moved, [](double code) { return 20 + 0.6 * code; });
  EXPECT_NEAR(Misregistration({truth, darker, {}}), 1, 0.05);
  EXPECT_NEAR(Misregistration({truth, Smoothed(moved, 1), {}}), 1, 0.05);
  EXPECT_NEAR(Misregistration({truth, Noisy(moved, 5), {}}), 1, 0.1);
}

TEST(Misregistration, TwoHalvesGiveTheMedian) {
  Image result = Waves(200, 100);
  const Image moved = Waves(200, 100, 2, 0);
  for (int y = 0; y < 100; ++y) {
    std::copy(moved.Pixel(70, y), moved.Pixel(0, y) + 600, result.Pixel(70, y));
  }
  EXPECT_NEAR(Misregistration({Waves(200, 100), result, {}}), 2, 0.1);
}

TEST(Misregistration, PlainWallsAndNoiseOnThemSayNothing) {
  const Image plain = Plain(100, 100, 120, 130, 140);
  EXPECT_TRUE(std::isnan(Misregistration({plain, plain, {}})));
  EXPECT_TRUE(std::isnan(Misregistration({Noisy(plain, 1), plain, {}})));
}

TEST(Misregistration, StripesSayNothingAlongThemselves) {
  Image stripes = Plain(100, 100, 100, 100, 100);
  for (int y = 0; y < 100; ++y) {
    for (int x = 0; x < 100; ++x) {
      if (x / 8 % 2 == 0) std::fill(stripes.Pixel(x, y), stripes.Pixel(x, y) + 3, uint8_t{200});
    }
  }
  EXPECT_TRUE(std::isnan(Misregistration({stripes, stripes, {}})));
}

TEST(Misregistration, WhatTheMaskHidesDoesNotMatter) {
  const Image truth = Waves(160, 140);
  Image result = Waves(160, 140, 1, 0);
  std::vector<uint8_t> mask(size_t{160} * 140, 1);
  for (int y = 40; y < 100; ++y) {
    for (int x = 0; x < 60; ++x) {
      mask[static_cast<size_t>(y) * 160 + x] = 0;
      for (int c = 0; c < 3; ++c) result.Pixel(x, y)[c] = 255;
    }
  }
  EXPECT_NEAR(Misregistration({truth, result, mask}), 1, 0.03);
  EXPECT_TRUE(
      std::isnan(Misregistration({truth, result, std::vector<uint8_t>(size_t{160} * 140, 0)})));
}

TEST(Misregistration, TinyPicturesSayNothingAndOddPairsAreRefused) {
  const Image pixel = Plain(1, 1, 9, 9, 9);
  EXPECT_TRUE(std::isnan(Misregistration({pixel, pixel, {}})));
  EXPECT_THROW(Misregistration({pixel, Plain(1, 2, 9, 9, 9), {}}), Error);
}

}  // namespace
}  // namespace stucco::evaluate
