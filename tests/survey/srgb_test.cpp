// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/srgb.h"

#include <gtest/gtest.h>

#include <cmath>

namespace stucco {
namespace {

TEST(Srgb, CodesComeBack) {
  for (int code = 0; code < 256; ++code) {
    EXPECT_EQ(SrgbCode(LinearFromSrgb(static_cast<uint8_t>(code))), code);
  }
}

TEST(Srgb, HasTheValuesOfTheStandard) {
  EXPECT_DOUBLE_EQ(LinearFromSrgb(0.04045), 0.04045 / 12.92);
  EXPECT_NEAR(LinearFromSrgb(0.5), 0.21404114, 1e-8);
  EXPECT_NEAR(SrgbFromLinear(0.18), 0.46135612, 1e-8);
  EXPECT_EQ(LinearFromSrgb(uint8_t{255}), 1.0f);
}

TEST(Srgb, LightThatNoScreenHasIsClamped) {
  EXPECT_EQ(SrgbCode(7.5), 255);
  EXPECT_EQ(SrgbCode(-1), 0);
  EXPECT_EQ(SrgbCode(std::nan("")), 0);
}

}  // namespace
}  // namespace stucco
