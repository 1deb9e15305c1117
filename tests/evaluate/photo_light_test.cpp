// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "evaluate/picture/photo_light.h"

#include <gtest/gtest.h>

#include <cmath>

#include "simulate/flight/sensor.h"

namespace stucco::evaluate {
namespace {

constexpr std::array<std::array<double, 3>, 2> kGains = {{{0.8, 1, 1.3}, {1.1, 0.9, 0.7}}};
constexpr Falloff kFalloff{-0.3, -0.05};

// Two photos with other gains, a few thousand places each; `error` is added to logarithms.
template <typename Error>
std::vector<std::vector<LightSample>> Samples(const Error& error) {
  std::vector<std::vector<LightSample>> photos(2);
  for (size_t p = 0; p < 2; ++p) {
    for (int i = 0; i < 3000; ++i) {
      LightSample sample;
      sample.radius_squared = std::fmod(i * 0.6180339887498949, 1.0);
      for (size_t c = 0; c < 3; ++c) {
        sample.log_ratios[c] =
            std::log(kGains[p][c] * kFalloff.At(sample.radius_squared)) + error(i);
      }
      photos[p].push_back(sample);
    }
  }
  return photos;
}

void ExpectFound(const PhotoLight& light, double tolerance) {
  EXPECT_NEAR(light.falloff.square, kFalloff.square, 3 * tolerance);
  EXPECT_NEAR(light.falloff.fourth, kFalloff.fourth, 3 * tolerance);
  for (size_t p = 0; p < 2; ++p) {
    for (size_t c = 0; c < 3; ++c) EXPECT_NEAR(light.gains[p][c], kGains[p][c], tolerance);
  }
}

TEST(FitPhotoLight, IsExactOnExactLight) {
  ExpectFound(FitPhotoLight(Samples([](int) { return 0.0; })), 1e-7);
}

TEST(FitPhotoLight, NoiseAveragesOut) {
  // Deviation 0.07 over 3000 places: 0.002 in the mean, some times that in the polynomial.
  ExpectFound(FitPhotoLight(Samples([](int i) { return 0.1 * std::sin(17.3 * i); })), 0.01);
}

TEST(FitPhotoLight, AFifthOfWrongPlacesHaveNoSay) {
  ExpectFound(FitPhotoLight(Samples([](int i) { return i % 5 == 0 ? 1.2 : 0.0; })), 1e-3);
}

TEST(FitPhotoLight, PlacesOfOneRadiusHaveGainsOnly) {
  const LightSample sample{{std::log(2), 0, std::log(0.5)}, 0.4};
  const PhotoLight light = FitPhotoLight({{sample, sample, sample}});
  EXPECT_NEAR(light.falloff.At(0.9), 1, 1e-6);
  EXPECT_NEAR(light.gains[0][0], 2, 1e-6);
  EXPECT_NEAR(light.gains[0][2], 0.5, 1e-6);
}

TEST(FitPhotoLight, NothingHasGainsOfOne) {
  const PhotoLight light = FitPhotoLight({{}, {}});
  EXPECT_EQ(light.gains, (std::vector<std::array<double, 3>>(2, {1, 1, 1})));
  EXPECT_EQ(light.falloff.At(1), 1);
  EXPECT_TRUE(FitPhotoLight({}).gains.empty());
}

TEST(RadiusSquared, IsOneInTheFarthestCorner) {
  const Camera camera{CameraId{1}, CameraModel::kSimplePinhole, 400, 300, {300, 210, 140}};
  EXPECT_NEAR(RadiusSquared(camera, 210, 140), 0, 1e-12);
  EXPECT_NEAR(RadiusSquared(camera, 0, 300), 1, 1e-12);
}

// A polynomial of two terms is enough for lenses that lose a third of the light in the corners.
TEST(FitPhotoLight, FollowsASimulatedLens) {
  const Camera camera{CameraId{1}, CameraModel::kSimplePinhole, 400, 300, {300, 210, 140}};
  std::vector<LightSample> photo;
  for (int y = 2; y < 300; y += 5) {
    for (int x = 2; x < 400; x += 5) {
      const double log = std::log(simulate::Vignetting(camera, 0.33, {x, y}));
      photo.push_back({{log, log, log}, RadiusSquared(camera, x, y)});
    }
  }
  const PhotoLight light = FitPhotoLight({photo});
  for (const LightSample& sample : photo) {
    EXPECT_NEAR(light.gains[0][0] * light.falloff.At(sample.radius_squared),
                std::exp(sample.log_ratios[0]), 0.005);
  }
}

}  // namespace
}  // namespace stucco::evaluate
