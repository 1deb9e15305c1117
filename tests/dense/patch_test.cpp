// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "dense/patch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

namespace stucco::test {
namespace {

constexpr int kSize = 64;
constexpr float kIdentity[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};

double Waves(double x, double y) {
  return 128 + 30 * std::sin(0.7 * x + 0.3 * y) + 25 * std::sin(-0.4 * x + 0.9 * y + 1) +
         20 * std::sin(0.25 * x - 0.15 * y + 2);
}

PackedImage Make(const std::function<double(double, double)>& gray) {
  std::vector<uint8_t> pixels;
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) {
      pixels.push_back(static_cast<uint8_t>(std::clamp(std::lround(gray(x, y)), 0l, 255l)));
    }
  }
  return Pack(kSize, kSize, std::move(pixels));
}

float CostAt(const PackedImage& reference, const PackedImage& source, const float h[9], int x,
             int y) {
  return PatchCost(MakeReferencePatch(reference, x, y), source, h,
                   {static_cast<float>(x), static_cast<float>(y)});
}

TEST(ReferencePatch, HasWeightsThatSumToOne) {
  const PackedImage image = Make(Waves);
  for (const auto& [x, y] : {std::pair{30, 30}, std::pair{0, 0}, std::pair{63, 63}}) {
    const ReferencePatch patch = MakeReferencePatch(image, x, y);
    EXPECT_NEAR(std::accumulate(patch.weights, patch.weights + kPatchSamples, 0.0), 1, 1e-5);
    EXPECT_NEAR(std::accumulate(patch.weighted, patch.weighted + kPatchSamples, 0.0), 0, 1e-4);
    EXPECT_GT(patch.variance, 10);
  }
}

TEST(PatchCost, ZeroForTheSamePatch) {
  const PackedImage image = Make(Waves);
  for (int y = 6; y < kSize - 7; y += 9) {
    for (int x = 6; x < kSize - 7; x += 7) {
      EXPECT_NEAR(CostAt(image, image, kIdentity, x, y), 0, 1e-4);
    }
  }
}

TEST(PatchCost, GrowsWithTheShift) {
  const PackedImage image = Make(Waves);
  float last = 0;
  for (const float shift : {0.0f, 0.3f, 0.7f, 1.2f, 1.8f}) {
    const float h[9] = {1, 0, shift, 0, 1, 0, 0, 0, 1};
    const float cost = CostAt(image, image, h, 30, 30);
    if (shift > 0) {
      EXPECT_GT(cost, last + 0.003f) << shift;
    }
    last = cost;
  }
  EXPECT_GT(last, 0.3f);
}

TEST(PatchCost, FollowsTheHomography) {
  // The source shows the reference turned, scaled and seen a bit obliquely.
  const double m[9] = {1.1, -0.15, 3.2, 0.1, 0.95, -1.7, 0.0015, -0.001, 1};
  const PackedImage source = Make(Waves);
  const PackedImage reference = Make([&](double x, double y) {
    const double z = m[6] * x + m[7] * y + m[8];
    return Waves((m[0] * x + m[1] * y + m[2]) / z, (m[3] * x + m[4] * y + m[5]) / z);
  });
  float h[9];
  std::copy(m, m + 9, h);
  EXPECT_LT(CostAt(reference, source, h, 30, 30), 0.02f);
  EXPECT_GT(CostAt(reference, source, kIdentity, 30, 30), 0.2f);
}

TEST(PatchCost, DoesNotMindBrightnessAndContrast) {
  const PackedImage image = Make(Waves);
  const PackedImage darker = Make([](double x, double y) { return 20 + 0.5 * Waves(x, y); });
  EXPECT_LT(CostAt(image, darker, kIdentity, 30, 30), 0.01f);
}

TEST(PatchCost, NoMatchOutsideThePicture) {
  const PackedImage image = Make(Waves);
  for (const auto& [dx, dy] :
       {std::pair{40.f, 0.f}, std::pair{-40.f, 0.f}, std::pair{0.f, 40.f}, std::pair{0.f, -40.f}}) {
    const float h[9] = {1, 0, dx, 0, 1, dy, 0, 0, 1};
    EXPECT_EQ(CostAt(image, image, h, 32, 32), kNoMatch);
  }
  EXPECT_EQ(CostAt(image, image, kIdentity, 2, 30), kNoMatch);  // the window sticks out
  const float behind[9] = {-1, 0, 0, 0, -1, 0, 0, 0, -1};
  EXPECT_EQ(CostAt(image, image, behind, 30, 30), kNoMatch);
  const float nowhere[9] = {NAN, 0, 0, 0, NAN, 0, 0, 0, NAN};
  EXPECT_EQ(CostAt(image, image, nowhere, 30, 30), kNoMatch);
}

TEST(PatchCost, NoMatchWithoutTexture) {
  const PackedImage image = Make(Waves);
  const PackedImage flat = Make([](double, double) { return 100.0; });
  EXPECT_EQ(CostAt(flat, image, kIdentity, 30, 30), kNoMatch);
  EXPECT_EQ(CostAt(image, flat, kIdentity, 30, 30), kNoMatch);
  EXPECT_EQ(CostAt(flat, flat, kIdentity, 30, 30), kNoMatch);
}

TEST(PatchCost, HasTheSameBitsWhateverTheProcessorCan) {
  const PackedImage image = Make(Waves);
  const std::vector<PatchCostCode> codes = PatchCostCodes();
  for (int k = 0; k < 400; ++k) {
    const auto shift = static_cast<float>(0.013 * k - 2);
    const float h[9] = {1.02f, 0.01f, shift, -0.02f, 0.98f, shift / 3, 1e-4f, -2e-4f, 1};
    const PixelPlace at{static_cast<float>(5 + k % 54), static_cast<float>(5 + k * 7 % 54)};
    const ReferencePatch patch =
        MakeReferencePatch(image, static_cast<int>(at.x), static_cast<int>(at.y));
    const float cost = codes.back()(patch, image, h, at);
    for (const PatchCostCode code : codes) EXPECT_EQ(code(patch, image, h, at), cost) << k;
  }
}

TEST(PatchCost, NeverLeavesItsRange) {
  const PackedImage image = Make(Waves);
  const PackedImage negative = Make([](double x, double y) { return 255 - Waves(x, y); });
  const float cost = CostAt(image, negative, kIdentity, 30, 30);
  EXPECT_GT(cost, 1.9f);
  EXPECT_LE(cost, kNoMatch);
}

}  // namespace
}  // namespace stucco::test
