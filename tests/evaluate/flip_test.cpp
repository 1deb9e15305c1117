// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "evaluate/picture/flip.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "survey/error.h"
#include "survey/srgb.h"
#include "tests/evaluate/made_pictures.h"

namespace stucco::evaluate {
namespace {

double Mean(const Image& truth, const Image& result) {
  return MeanError(Flip({truth, result, {}}));
}

// CIELAB's lightness of a grey code.
double Lightness(uint8_t code) {
  return 116 * std::cbrt(LinearFromSrgb(code)) - 16;
}

TEST(Flip, EqualPicturesHaveNoError) {
  const Image picture = Waves(80, 70);
  for (const float error : Flip({picture, picture, {}}).error) EXPECT_EQ(error, 0);
}

TEST(Flip, OfGreenAndBlueIsTheLargestError) {
  EXPECT_NEAR(Mean(Plain(30, 30, 0, 255, 0), Plain(30, 30, 0, 0, 255)), 1, 1e-5);
}

TEST(Flip, OfPlainGreysFollowsFromTheirLightness) {
  // By hand: green has L* 87.735, a* -86.183, b* 83.179, blue 32.297, 79.188, -107.860; times
  // 0.01 L* (Hunt): -75.612, 72.977 and 25.575, -34.836. HyAB = 55.438 + 147.824 = 203.262.
  const double largest = std::pow(203.262, 0.7);
  const double black_white = std::pow(100, 0.7);
  const double expected = 0.95 + 0.05 * (black_white - 0.4 * largest) / (largest - 0.4 * largest);
  EXPECT_NEAR(expected, 0.9673, 1e-4);
  EXPECT_NEAR(Mean(Plain(5, 5, 0, 0, 0), Plain(5, 5, 255, 255, 255)), expected, 1e-4);
  const double grey = std::pow(Lightness(140) - Lightness(120), 0.7);
  EXPECT_NEAR(Mean(Plain(5, 5, 120, 120, 120), Plain(5, 5, 140, 140, 140)),
              grey * 0.95 / (0.4 * largest), 1e-4);
}

// By direct sums over two-dimensional kernels in double precision (numpy), with a matrix that
// follows from the primaries and the white of sRGB.
TEST(Flip, AgreesWithAnIndependentProgram) {
  const PicturePair pair{Waves(240, 200), Waves(240, 200, 1.5, 0.5), {}};
  const FlipMap map = Flip(pair);
  EXPECT_NEAR(MeanError(map), 0.252868, 2e-5);
  EXPECT_NEAR(map.error[size_t{100} * 240 + 120], 0.112350, 1e-4);
  EXPECT_NEAR(MeanError(Flip(pair, 30)), 0.295837, 2e-5);
}

TEST(Flip, SeesAnEdgeThatIsMissing) {
  // Far from the edge the halves are equal; at the edge its difference raises the colour's error.
  Image step = Plain(80, 40, 100, 100, 100);
  for (int y = 0; y < 40; ++y) {
    for (int x = 40; x < 80; ++x) {
      for (int c = 0; c < 3; ++c) step.Pixel(x, y)[c] = 140;
    }
  }
  const FlipMap map = Flip({step, Plain(80, 40, 100, 100, 100), {}});
  const auto at = [&](int x) { return map.error[static_cast<size_t>(20) * 80 + x]; };
  EXPECT_EQ(at(5), 0);
  const double plain = Mean(Plain(9, 9, 140, 140, 140), Plain(9, 9, 100, 100, 100));
  EXPECT_NEAR(at(75), plain, 1e-4);
  EXPECT_GT(at(42), plain + 0.05);
}

TEST(Flip, AThinLineMattersLessFromAfar) {
  Image line = Plain(60, 60, 128, 128, 128);
  for (int y = 0; y < 60; ++y) {
    for (int c = 0; c < 3; ++c) line.Pixel(30, y)[c] = 200;
  }
  const PicturePair pair{line, Plain(60, 60, 128, 128, 128), {}};
  const auto at_line = [&](double pixels_per_degree) {
    return Flip(pair, pixels_per_degree).error[size_t{30} * 60 + 30];
  };
  EXPECT_GT(at_line(20), at_line(67));
  EXPECT_GT(at_line(67), at_line(150));
}

TEST(Flip, IsSymmetricAndGrowsWithTheError) {
  const Image truth = Waves(100, 100);
  EXPECT_NEAR(Mean(truth, Smoothed(truth, 2)), Mean(Smoothed(truth, 2), truth), 1e-9);
  const auto rises = [&](const auto& change) {
    double last = 0;
    for (const double amount : {1.0, 2.0, 4.0}) {
      const double error = Mean(truth, change(amount));
      EXPECT_GT(error, last);
      EXPECT_LE(error, 1);
      last = error;
    }
  };
  rises([&](double amount) { return Noisy(truth, 6 * amount); });
  rises([&](double amount) { return Smoothed(truth, amount); });
  rises([&](double amount) { return Waves(100, 100, amount / 2); });
  rises([&](double amount) {
    return Changed(truth, [&](double code) { return code + 5 * amount; });
  });
}

TEST(Flip, WhatTheMaskHidesDoesNotMatter) {
  const Image truth = Waves(70, 60);
  const Image result = Noisy(truth, 10);
  Image spoilt = result;
  std::vector<uint8_t> mask(size_t{70} * 60, 1);
  for (int y = 0; y < 60; ++y) {
    for (int x = 0; x < 20; ++x) {
      mask[static_cast<size_t>(y) * 70 + x] = 0;
      for (int c = 0; c < 3; ++c) spoilt.Pixel(x, y)[c] = 255;
    }
  }
  const FlipMap map = Flip({truth, result, mask});
  const FlipMap other = Flip({truth, spoilt, mask});
  const FlipMap whole = Flip({truth, result, {}});
  for (int x = 0; x < 70; ++x) {
    const size_t i = static_cast<size_t>(30) * 70 + x;
    if (x < 30) {
      EXPECT_TRUE(std::isnan(map.error[i])) << x;
    } else {
      EXPECT_EQ(map.error[i], other.error[i]) << x;
      EXPECT_EQ(map.error[i], whole.error[i]) << x;
    }
  }
  EXPECT_EQ(MeanError(map), MeanError(other));
}

TEST(Flip, OnePixelIsMeasuredAndAHiddenPictureIsNot) {
  EXPECT_NEAR(Mean(Plain(1, 1, 0, 0, 0), Plain(1, 1, 255, 255, 255)), 0.9673, 1e-4);
  const Image picture = Waves(16, 16);
  const FlipMap hidden = Flip({picture, picture, std::vector<uint8_t>(256, 0)});
  EXPECT_TRUE(std::isnan(MeanError(hidden)));
  EXPECT_THROW(Flip({picture, Waves(15, 16), {}}), Error);
}

TEST(Flip, ItsPictureShowsWhereNothingWasMeasured) {
  FlipMap map{3, 1, {0, 1, std::nanf("")}};
  const Image image = Coloured(map);
  EXPECT_LT(*std::max_element(image.Pixel(0, 0), image.Pixel(0, 0) + 3), 10);
  EXPECT_GT(image.Pixel(1, 0)[0], 240);  // red and green: yellow
  EXPECT_GT(image.Pixel(1, 0)[1], 240);
  for (int c = 0; c < 3; ++c) EXPECT_EQ(image.Pixel(2, 0)[c], 0x80);
}

}  // namespace
}  // namespace stucco::evaluate
