// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/light/colour.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace stucco {
namespace {

ColourRatio Ratio(int a, int b, double ratio) {
  return {a, b, Eigen::Vector3d::Constant(std::log(ratio)), 500};
}

TEST(MeasureRatio, IsTheMedianOverTexelsThatBothShowUnclipped) {
  std::vector<float> a;
  std::vector<float> b;
  std::vector<uint8_t> both;
  std::mt19937 random(1);
  for (int i = 0; i < 200; ++i) {
    const auto value = static_cast<float>(40 + random() % 100);
    for (int k = 0; k < 3; ++k) {
      a.push_back(value * (k == 0 ? 1.5f : 1.2f));
      b.push_back(value);
    }
    both.push_back(1);
    if (i % 5 == 0) a[3 * i] = 255;                     // clipped
    if (i % 7 == 0) std::fill_n(&b[3 * i], 3, 200.0f);  // a car
    if (i % 11 == 0) {
      both[i] = 0;
      std::fill_n(&a[3 * i], 3, 0.0f);
    }
  }
  const auto ratio = MeasureRatio(3, 4, a, b, both);
  ASSERT_TRUE(ratio);
  EXPECT_EQ(ratio->a, 3);
  EXPECT_NEAR(ratio->log_ratio[0], std::log(1.5), 1e-3);
  EXPECT_NEAR(ratio->log_ratio[1], std::log(1.2), 1e-3);
}

TEST(MeasureRatio, NeedsEnoughTexels) {
  const std::vector<float> rgb(30, 100);
  EXPECT_FALSE(MeasureRatio(0, 1, rgb, rgb, std::vector<uint8_t>(10, 1)));
}

TEST(SolveGains, EvensOutExposures) {
  // Exposures 1, 1.5, 0.8, seen in a chain and once around.
  const std::vector<double> exposure = {1, 1.5, 0.8};
  std::vector<ColourRatio> ratios;
  for (int a = 0; a < 3; ++a) {
    for (int b = a + 1; b < 3; ++b) ratios.push_back(Ratio(a, b, exposure[a] / exposure[b]));
  }
  const auto gains = SolveGains(ratios, 4);
  for (int i = 1; i < 3; ++i) {
    EXPECT_NEAR(gains[i][0] * exposure[i], gains[0][0] * exposure[0], 0.005);
  }
  double product = 1;
  for (int i = 0; i < 3; ++i) product *= gains[i][1];
  EXPECT_NEAR(product, 1, 1e-3);  // overall brightness stays
  EXPECT_EQ(gains[3], Eigen::Vector3d::Ones());
}

TEST(SolveGains, OutvotesAWrongRatio) {
  std::vector<ColourRatio> ratios(6, Ratio(0, 1, 1.2));
  ratios.push_back(Ratio(0, 1, 4));
  const auto gains = SolveGains(ratios, 2);
  EXPECT_NEAR(gains[1][2] / gains[0][2], 1.2, 0.05);
}

TEST(SolveGains, APhotoFullOfLeavesIsNotTinted) {
  std::vector<ColourRatio> ratios;
  for (int a = 0; a < 6; ++a) {
    for (int b = a + 1; b < 6; ++b) ratios.push_back(Ratio(a, b, 1));
  }
  for (int a = 0; a < 6; ++a) {
    ratios.push_back({a, 6, -Eigen::Vector3d(std::log(0.5), std::log(0.8), std::log(0.4)), 500});
  }
  const auto gains = SolveGains(ratios, 7);
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(gains[6][k] / gains[6].mean(), 1, 0.06);
  EXPECT_GT(gains[6].mean(), 1.5);  // that it is darker may be so
}

TEST(SolveGains, AnotherWhiteBalanceOfHalfThePhotosIsEvenedOut) {
  const Eigen::Vector3d warm(std::log(1.2), 0, std::log(0.8));
  std::vector<ColourRatio> ratios;
  for (int a = 0; a < 6; ++a) {
    for (int b = a + 1; b < 6; ++b) {
      const bool differ = a < 3 && b >= 3;
      ratios.push_back({a, b, differ ? warm : Eigen::Vector3d::Zero(), 500});
    }
  }
  const auto gains = SolveGains(ratios, 6);
  for (int k = 0; k < 3; ++k) {
    EXPECT_NEAR(std::log(gains[5][k] / gains[0][k]), warm[k], 0.01);
  }
}

TEST(CommonGain, OneRepaintedFacetDoesNotRecolourTheOthers) {
  std::vector<ColourRatio> ratios(4, Ratio(0, 1, 1.25));
  ratios[2].log_ratio = {0.1, -0.6, -0.7};
  for (const double gain : CommonGain(ratios)) EXPECT_NEAR(gain, 0.8, 1e-9);
}

TEST(CommonGain, FacetsThatDisagreeOnTheHueKeepIt) {
  std::vector<ColourRatio> ratios(5, Ratio(0, 1, 1));
  for (int i = 0; i < 5; ++i) ratios[i].log_ratio = {0.2 + 0.1 * i, 0.2, 0.2 - 0.15 * i};
  const Eigen::Vector3d gain = CommonGain(ratios);
  EXPECT_EQ(gain.x(), gain.y());
  EXPECT_EQ(gain.y(), gain.z());
}

TEST(CommonGain, OfFewFacetsKeepsTheHue) {
  std::vector<ColourRatio> ratios(1, Ratio(0, 1, 1));
  ratios[0].log_ratio = {0.3, 0, 0};
  for (const double gain : CommonGain(ratios)) EXPECT_NEAR(gain, std::exp(-0.1), 1e-9);
  EXPECT_EQ(CommonGain({}), Eigen::Vector3d::Ones());
}

TEST(SolveGains, OfNothingIsOne) {
  for (const auto& gain : SolveGains({}, 3)) EXPECT_EQ(gain, Eigen::Vector3d::Ones());
}

}  // namespace
}  // namespace stucco
