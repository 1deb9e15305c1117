// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/light/solve_light.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace stucco {
namespace {

ColourRatio Ratio(int a, int b, double ratio) {
  return {.a = a, .b = b, .log_ratio = Eigen::Vector3d::Constant(std::log(ratio)), .weight = 500};
}

// Of photos of one lens.
std::vector<Eigen::Vector3d> Gains(const std::vector<ColourRatio>& ratios, size_t photos) {
  return SolveLight(ratios, std::vector<TakenPhoto>(photos)).gains;
}

TEST(SolveLight, EvensOutExposures) {
  // Exposures 1, 1.5, 0.8, seen in a chain and once around.
  const std::vector<double> exposure = {1, 1.5, 0.8};
  std::vector<ColourRatio> ratios;
  for (int a = 0; a < 3; ++a) {
    for (int b = a + 1; b < 3; ++b) ratios.push_back(Ratio(a, b, exposure[a] / exposure[b]));
  }
  const auto gains = Gains(ratios, 4);
  for (int i = 1; i < 3; ++i) {
    EXPECT_NEAR(gains[i][0] * exposure[i], gains[0][0] * exposure[0], 0.005);
  }
  double product = 1;
  for (int i = 0; i < 3; ++i) product *= gains[i][1];
  EXPECT_NEAR(product, 1, 1e-3);  // overall brightness stays
  EXPECT_EQ(gains[3], Eigen::Vector3d::Ones());
}

TEST(SolveLight, OutvotesAWrongRatio) {
  std::vector<ColourRatio> ratios(6, Ratio(0, 1, 1.2));
  ratios.push_back(Ratio(0, 1, 4));
  const auto gains = Gains(ratios, 2);
  EXPECT_NEAR(gains[1][2] / gains[0][2], 1.2, 0.05);
}

TEST(SolveLight, APhotoFullOfLeavesIsNotTinted) {
  std::vector<ColourRatio> ratios;
  for (int a = 0; a < 6; ++a) {
    for (int b = a + 1; b < 6; ++b) ratios.push_back(Ratio(a, b, 1));
  }
  for (int a = 0; a < 6; ++a) {
    ratios.push_back(Ratio(a, 6, 1));
    ratios.back().log_ratio = -Eigen::Vector3d(std::log(0.5), std::log(0.8), std::log(0.4));
  }
  const auto gains = Gains(ratios, 7);
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(gains[6][k] / gains[6].mean(), 1, 0.06);
  EXPECT_GT(gains[6].mean(), 1.5);  // that it is darker may be so
}

TEST(SolveLight, AnotherWhiteBalanceOfHalfThePhotosIsEvenedOut) {
  const Eigen::Vector3d warm(std::log(1.2), 0, std::log(0.8));
  std::vector<ColourRatio> ratios;
  for (int a = 0; a < 6; ++a) {
    for (int b = a + 1; b < 6; ++b) {
      const bool differ = a < 3 && b >= 3;
      ratios.push_back(Ratio(a, b, 1));
      if (differ) ratios.back().log_ratio = warm;
    }
  }
  const auto gains = Gains(ratios, 6);
  for (int k = 0; k < 3; ++k) {
    EXPECT_NEAR(std::log(gains[5][k] / gains[0][k]), warm[k], 0.01);
  }
}

// A row of photos that each share a wall with the next two, whose ratios all lean the same way.
std::vector<ColourRatio> LeaningRow(int photos, double lean) {
  std::vector<ColourRatio> ratios;
  for (int a = 0; a < photos; ++a) {
    for (int b = a + 1; b < std::min(photos, a + 3); ++b) {
      ratios.push_back(Ratio(a, b, std::exp(lean * (b - a))));
    }
  }
  return ratios;
}

TEST(SolveLight, KnownExposuresHoldTheEndsOfALongRow) {
  constexpr int kPhotos = 80;
  const std::vector<ColourRatio> ratios = LeaningRow(kPhotos, 0.005);
  std::vector<TakenPhoto> photos(kPhotos);
  const auto lean = [&] {
    const auto gains = SolveLight(ratios, photos).gains;
    return std::abs(std::log(gains.back()[1] / gains.front()[1]));
  };
  EXPECT_GT(lean(), 0.3);
  for (TakenPhoto& photo : photos) photo.log_exposure = -3.5;
  EXPECT_LT(lean(), 0.12);
}

TEST(SolveLight, AnotherExposureIsEvenedOutWithoutARatio) {
  std::vector<ColourRatio> ratios = {Ratio(0, 1, 1), Ratio(2, 3, 1)};
  const double brighter = std::log(1.3);
  const std::vector<TakenPhoto> photos = {
      {0, 0.0, {}}, {0, 0.0, {}}, {0, brighter, {}}, {0, brighter, {}}};
  const auto gains = SolveLight(ratios, photos).gains;
  EXPECT_NEAR(std::log(gains[0][0] / gains[2][0]), brighter, 0.03);
}

TEST(SolveLight, WhatChangedInHoursIsNoExposure) {
  const std::vector<ColourRatio> ratios = {Ratio(0, 1, 1.6)};
  const auto differ = [&](double hours) {
    const std::vector<TakenPhoto> photos = {{0, 0.0, 9.0}, {0, 0.0, 9.0 + hours}};
    const auto gains = SolveLight(ratios, photos).gains;
    return std::log(gains[1][0] / gains[0][0]);
  };
  EXPECT_GT(differ(0.01), 0.8 * std::log(1.6));
  EXPECT_LT(differ(3), 0.15 * std::log(1.6));
}

TEST(SolveLight, OfNothingIsOne) {
  for (const auto& gain : Gains({}, 3)) EXPECT_EQ(gain, Eigen::Vector3d::Ones());
}

// Photos of two lenses, each with an exposure of its own, that show walls at all places of their
// pictures.
std::vector<ColourRatio> RatiosWith(const std::vector<Falloff>& lenses,
                                    const std::vector<double>& exposures, double noise) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> anywhere(0, 1);
  std::normal_distribution<double> off(0, noise);
  std::vector<ColourRatio> ratios;
  const auto photos = static_cast<int>(exposures.size());
  for (int a = 0; a < photos; ++a) {
    for (int b = a + 1; b < photos; ++b) {
      const double at_a = anywhere(random), at_b = anywhere(random);
      const double loss = lenses[a % 2].LogAt(at_a) - lenses[b % 2].LogAt(at_b);
      ratios.push_back(Ratio(a, b, exposures[a] / exposures[b] * std::exp(loss + off(random))));
      ratios.back().corner_a = {at_a, at_a * at_a};
      ratios.back().corner_b = {at_b, at_b * at_b};
    }
  }
  return ratios;
}

TEST(SolveLight, FindsTheFalloffOfEachLensAndTheExposures) {
  const std::vector<Falloff> lenses = {{{-0.10, -0.05}}, {{-0.02, -0.2}}};
  std::vector<double> exposures;
  std::vector<TakenPhoto> photos;
  for (int i = 0; i < 30; ++i) {
    exposures.push_back(1 + 0.02 * (i % 7));
    photos.push_back({i % 2, {}, {}});
  }
  const PhotosLight light = SolveLight(RatiosWith(lenses, exposures, 0.01), photos);
  for (int i = 0; i < 30; ++i) {
    for (const double share : {0.3, 0.6, 1.0}) {
      EXPECT_NEAR(light.falloffs[i].LogAt(share), lenses[i % 2].LogAt(share), 0.015) << i;
    }
    EXPECT_NEAR(light.gains[i][0] * exposures[i] / (light.gains[0][0] * exposures[0]), 1, 0.015);
  }
}

TEST(SolveLight, NoiseIsNoFalloff) {
  const std::vector<Falloff> lenses(2);
  const std::vector<double> exposures(8, 1.0);
  std::vector<TakenPhoto> photos;
  for (int i = 0; i < 8; ++i) photos.push_back({i % 2, {}, {}});
  const PhotosLight light = SolveLight(RatiosWith(lenses, exposures, 0.02), photos);
  for (const Falloff& falloff : light.falloffs) EXPECT_TRUE(falloff.IsNone());
}

}  // namespace
}  // namespace stucco
