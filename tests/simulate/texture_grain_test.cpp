// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulate/render/internal/texture_grain.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "simulate/random.h"
#include "simulate/render/renderer.h"
#include "tests/simulate/scenes.h"

namespace stucco::simulate {
namespace {

using internal::Footprint;
using internal::TextureGrain;
using test::LookAt;

constexpr int kSide = 256;

// Grey of 128 with independent noise of `sigma` codes in cells of 2 x 2 texels.
Image Speckled(double sigma) {
  Random random(4);
  Image image{kSide, kSide, 3, std::vector<uint8_t>(3 * kSide * kSide)};
  for (int y = 0; y < kSide; y += 2) {
    for (int x = 0; x < kSide; x += 2) {
      const auto code = static_cast<uint8_t>(std::lround(128 + sigma * random.Normal()));
      for (int k = 0; k < 4; ++k) {
        for (int c = 0; c < 3; ++c) image.Pixel(x + k % 2, y + k / 2)[c] = code;
      }
    }
  }
  return image;
}

Image Even(uint8_t code, int side = kSide) {
  return {side, side, 3, std::vector<uint8_t>(size_t{3} * side * side, code)};
}

// A square pixel of `texels` at (x, y) in texels.
Footprint PixelAt(double x, double y, double texels) {
  const auto side = static_cast<float>(texels / kSide);
  return {{static_cast<float>(x / kSide), static_cast<float>(y / kSide)}, {side, 0}, {0, side}};
}

struct Moments {
  double mean = 0;
  double sigma = 0;
};
Moments MomentsOf(const TextureGrain& grain, double texels) {
  Random random(5);
  constexpr int kCount = 40000;
  double sum = 0, squares = 0;
  for (int i = 0; i < kCount; ++i) {
    const double factor =
        grain.At(PixelAt(random.Uniform(8, kSide - 8), random.Uniform(8, kSide - 8), texels));
    sum += factor;
    squares += factor * factor;
  }
  const double mean = sum / kCount;
  return {mean, std::sqrt(std::max(0.0, squares / kCount - mean * mean))};
}

TEST(TextureGrain, ContinuesTheSpectrumOfTheTexture) {
  // Cells of noise lose a quarter of their variance to the mean of four: what is left is the
  // octave's. 6 codes of 128 are 0.103 in the logarithm of light.
  const TextureGrain grain(Speckled(6), 1);
  const double octave = 2.2 * 6 / 128 * std::sqrt(0.75);
  // A pixel of a quarter of a texel shows two octaves whole, one of half a texel only the first.
  const double first = 0.75 * octave, second = 0.75 * first;
  EXPECT_NEAR(MomentsOf(grain, 0.5).sigma, first, 0.12 * first);
  EXPECT_NEAR(MomentsOf(grain, 0.25).sigma, std::hypot(first, second), 0.12 * first);
  for (const double texels : {0.05, 0.25, 0.5}) {
    EXPECT_NEAR(MomentsOf(grain, texels).mean, 1, 0.004) << texels;
  }
  const double doubled = MomentsOf(TextureGrain(Speckled(12), 1), 0.5).sigma;
  EXPECT_NEAR(doubled / MomentsOf(grain, 0.5).sigma, 2, 0.15);
}

TEST(TextureGrain, FadesOutAsPixelsGrowToATexel) {
  const TextureGrain grain(Speckled(6), 1);
  double before = 1;
  for (const double texels : {0.5, 0.7, 0.9, 0.98}) {
    const double sigma = MomentsOf(grain, texels).sigma;
    EXPECT_LT(sigma, before);
    before = sigma;
  }
  EXPECT_LT(before, 0.01);
  EXPECT_EQ(MomentsOf(grain, 1).sigma, 0);
  // A pixel that is long in one direction shows nothing finer than its length.
  Footprint slanted = PixelAt(100, 100, 0.1);
  slanted.down *= 20;
  EXPECT_EQ(grain.At(slanted), 1);
}

TEST(TextureGrain, EvenColoursAndEdgesHaveNone) {
  EXPECT_EQ(MomentsOf(TextureGrain(Even(140), 1), 0.1).sigma, 0);
  // Tiles of 32 texels between joints of two.
  Image tiles = Even(150);
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      if (x % 32 < 2 || y % 32 < 2) std::fill_n(tiles.Pixel(x, y), 3, uint8_t{60});
    }
  }
  EXPECT_EQ(MomentsOf(TextureGrain(tiles, 1), 0.1).sigma, 0);
}

TEST(TextureGrain, BadPlacesAndSmallTexturesAreHarmless) {
  const TextureGrain grain(Speckled(6), 1);
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(grain.At(PixelAt(kNan, 1, 0.1)), 1);
  EXPECT_EQ(grain.At(PixelAt(1, 1, kNan)), 1);
  EXPECT_EQ(grain.At(PixelAt(1e30, -1e30, 0.1)), 1);
  const TextureGrain tiny(Even(9, 1), 1);
  EXPECT_EQ(tiny.At(PixelAt(1, 1, 1e-3)), 1);
}

// Two cameras at different distances see the same detail at the same places.
TEST(TextureGrain, BelongsToTheSurface) {
  Scene scene;
  // 10 m wide: texels of 39 mm.
  test::AddQuad(scene, {{-5, 0, 5}, {10, 0, 0}, {0, 0, -10}}, test::AddTexture(scene, Speckled(6)));
  const Renderer renderer(std::move(scene));
  const auto grain_from = [&](double distance, double focal) {
    const Camera camera = test::Pinhole(120, 120, focal);
    const Pose pose = LookAt({0, -distance, 0}, {0, 0, 0});
    Light flat;
    flat.sun.setZero();
    flat.sky.setOnes();
    const std::vector<float> lit = renderer.Photograph(camera, pose, flat).rgb;
    flat.lit = false;  // the texture alone
    const std::vector<float> plain = renderer.Photograph(camera, pose, flat).rgb;
    std::vector<double> grain;
    for (size_t i = 0; i < lit.size(); i += 3) grain.push_back(lit[i] / plain[i]);
    return grain;
  };
  const auto near = grain_from(2, 200);  // pixels of 10 mm
  const auto far = grain_from(6, 600);
  double both = 0, one = 0, other = 0, mean_near = 0, mean_far = 0;
  for (size_t i = 0; i < near.size(); ++i) mean_near += near[i] / near.size();
  for (size_t i = 0; i < far.size(); ++i) mean_far += far[i] / far.size();
  for (size_t i = 0; i < near.size(); ++i) {
    const double a = near[i] / mean_near - 1, b = far[i] / mean_far - 1;
    both += a * b;
    one += a * a;
    other += b * b;
  }
  EXPECT_GT(std::sqrt(one / near.size()), 0.03);
  EXPECT_GT(both / std::sqrt(one * other), 0.95);
}

}  // namespace
}  // namespace stucco::simulate
