// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "evaluate/picture/tone.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "simulate/flight/sensor.h"

namespace stucco::evaluate {
namespace {

TEST(Tone, CodesComeBack) {
  for (int code = 0; code < 256; ++code) {
    EXPECT_EQ(CodeOfLight(LightOfCode(static_cast<uint8_t>(code))), code);
  }
}

TEST(Tone, IsTheCamerasCurve) {
  for (const double light : {0.0, 0.001, 0.02, 0.18, 0.5, 0.69, 0.75, 1.0, 1.7}) {
    EXPECT_NEAR(CodeOfLight(light), 255 * simulate::CameraCurve(light), 0.5001) << light;
  }
  EXPECT_EQ(CodeOfLight(1000), 255);
  EXPECT_EQ(CodeOfLight(-1), 0);
}

TEST(FitGains, IsTheMedianOfWhatIsNeitherDarkNorBright) {
  LightPairs pairs;
  std::mt19937 random(3);
  for (int i = 0; i < 2001; ++i) {
    const float light = 0.05f + 0.4f * static_cast<float>(random()) / 4294967296.0f;
    const float truth[3] = {light, light, light};
    // Every fifth spot shows something else.
    const float other = i % 5 == 0 ? 1.5f : 1.0f;
    const float result[3] = {0.8f * light * other, 1.2f * light, 1.5f * light};
    pairs.Add(truth, result);
  }
  const float white[3] = {0.5f, 0.5f, 0.5f};
  const float burnt[3] = {2, 2, 2};
  const float night[3] = {0, 0, 0};
  const size_t before = pairs.log_ratios[0].size();
  pairs.Add(white, burnt);
  pairs.Add(white, night);
  pairs.Add(night, white);
  EXPECT_EQ(pairs.log_ratios[0].size(), before);
  const auto gains = FitGains(pairs);
  EXPECT_NEAR(gains[0], 0.8, 1e-5);
  EXPECT_NEAR(gains[1], 1.2, 1e-5);
  EXPECT_NEAR(gains[2], 1.5, 1e-5);
}

TEST(FitGains, NothingKeepsTheLight) {
  EXPECT_EQ(FitGains({}), (std::array<double, 3>{1, 1, 1}));
}

TEST(Developed, AppliesGainsByChannel) {
  const std::vector<float> light = {0.1f, 0.1f, 0.1f, 0.2f, 0.2f, 0.2f};
  const Image image = Developed(light, {2, 1}, {1, 2, 0});
  EXPECT_EQ(image.Pixel(0, 0)[1], image.Pixel(1, 0)[0]);
  EXPECT_EQ(image.Pixel(1, 0)[2], 0);
  EXPECT_EQ(image.Pixel(0, 0)[0], CodeOfLight(0.1f));
}

}  // namespace
}  // namespace stucco::evaluate
