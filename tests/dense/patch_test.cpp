// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "dense/patch.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numeric>

namespace stucco::test {
namespace {

constexpr int kSize = 64;
constexpr float kIdentity[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};

// Around a pixel, of a homography that maps reference to source pixels, row by row.
PatchWarp WarpOf(const float h[9], int x, int y) {
  PatchWarp warp;
  for (int row = 0; row < 3; ++row) {
    const float* of = h + 3 * row;
    warp.right[row] = of[0];
    warp.down[row] = of[1];
    warp.at[row] = of[0] * static_cast<float>(x) + of[1] * static_cast<float>(y) + of[2];
  }
  return warp;
}

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
  return PatchCost(MakeReferencePatch(reference, x, y), source, WarpOf(h, x, y));
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
  const std::vector<PatchCode> codes = PatchCodes();
  for (int k = 0; k < 400; ++k) {
    const auto shift = static_cast<float>(0.013 * k - 2);
    const float h[9] = {1.02f, 0.01f, shift, -0.02f, 0.98f, shift / 3, 1e-4f, -2e-4f, 1};
    const int x = 5 + k % 54;
    const int y = 5 + k * 7 % 54;
    const ReferencePatch patch = MakeReferencePatch(image, x, y);
    PatchWarp warp = WarpOf(h, x, y);
    warp.nearer = {3, 1, 0.1f};
    const float cost = codes.back().cost(patch, image, warp);
    StepSums sums;
    codes.back().add_step(patch, image, warp, sums);
    for (const PatchCode& code : codes) {
      const ReferencePatch made = code.reference(image, x % 7, y);  // partly outside, too
      const ReferencePatch other = codes.back().reference(image, x % 7, y);
      EXPECT_TRUE(std::ranges::equal(made.weights, other.weights)) << k;
      EXPECT_TRUE(std::ranges::equal(made.weighted, other.weighted)) << k;
      EXPECT_EQ(made.variance, other.variance) << k;
      EXPECT_EQ(code.cost(patch, image, warp), cost) << k;
      StepSums same;
      code.add_step(patch, image, warp, same);
      EXPECT_EQ(same.square, sums.square) << k;
      EXPECT_EQ(same.slope, sums.slope) << k;
    }
  }
}

TEST(PatchCost, NeverLeavesItsRange) {
  const PackedImage image = Make(Waves);
  const PackedImage negative = Make([](double x, double y) { return 255 - Waves(x, y); });
  const float cost = CostAt(image, negative, kIdentity, 30, 30);
  EXPECT_GT(cost, 1.9f);
  EXPECT_LE(cost, kNoMatch);
}

// The source shows the reference a pixel further left and with twice the contrast; a plane of the
// inverse depth d is seen 3 d further right. From planes that are off by a shift and by slopes one
// step leads to the truth but for what is of second order.
TEST(AddStep, LeadsToTheTruePlane) {
  // Waves long enough for lines between pixels to follow them.
  const auto smooth = [](double x, double y) { return Waves(0.4 * x, 0.4 * y); };
  const PackedImage reference = Make([&](double x, double y) { return 64 + smooth(x, y) / 2; });
  const PackedImage source = Make([&](double x, double y) { return smooth(x + 1, y); });
  for (const auto& [shift, right, down] :
       {std::array{0.1f, 0.0f, 0.0f}, std::array{-0.08f, 0.0f, 0.0f}, std::array{0.0f, 0.01f, 0.0f},
        std::array{0.03f, -0.006f, 0.008f}}) {
    const std::array<float, 3> plane = {-1.0f / 3 + shift, right, down};
    PatchWarp warp{{30 + 3 * plane[0], 30, 1}, {1 + 3 * right, 0, 0}, {3 * down, 1, 0}, {3, 0, 0}};
    StepSums sums;
    AddStep(MakeReferencePatch(reference, 30, 30), source, warp, sums);
    Eigen::Matrix3d square;
    square << sums.square[0], sums.square[1], sums.square[2], sums.square[1], sums.square[3],
        sums.square[4], sums.square[2], sums.square[4], sums.square[5];
    const Eigen::Vector3d step =
        square.ldlt().solve(Eigen::Vector3d(sums.slope[0], sums.slope[1], sums.slope[2]));
    EXPECT_NEAR(step[0], shift, 0.012) << shift;
    EXPECT_NEAR(step[1], right, 0.003) << right;
    EXPECT_NEAR(step[2], down, 0.003) << down;
  }
}

TEST(AddStep, AddsNothingWhereNothingMatches) {
  const PackedImage image = Make(Waves);
  const PackedImage flat = Make([](double, double) { return 100.0; });
  const ReferencePatch patch = MakeReferencePatch(image, 30, 30);
  const float outside[9] = {1, 0, 40, 0, 1, 0, 0, 0, 1};
  StepSums sums;
  AddStep(patch, flat, WarpOf(kIdentity, 30, 30), sums);
  AddStep(patch, image, WarpOf(outside, 30, 30), sums);
  EXPECT_EQ(sums.square, StepSums().square);
  EXPECT_EQ(sums.slope, StepSums().slope);
}

}  // namespace
}  // namespace stucco::test
