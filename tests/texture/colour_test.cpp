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
  const auto ratios = MeasureRatios({3, a, {}}, {4, b, {}}, both);
  ASSERT_EQ(ratios.size(), 1u);
  EXPECT_EQ(ratios[0].a, 3);
  EXPECT_NEAR(ratios[0].log_ratio[0], std::log(1.5), 1e-3);
  EXPECT_NEAR(ratios[0].log_ratio[1], std::log(1.2), 1e-3);
}

TEST(MeasureRatio, NeedsEnoughTexels) {
  const std::vector<float> rgb(30, 100);
  EXPECT_TRUE(MeasureRatios({0, rgb, {}}, {1, rgb, {}}, std::vector<uint8_t>(10, 1)).empty());
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

}  // namespace
}  // namespace stucco
