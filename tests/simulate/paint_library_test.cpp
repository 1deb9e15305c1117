// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>

#include "simulate/paint/internal/library.h"
#include "simulate/paint/internal/noise.h"
#include "survey/srgb.h"

namespace stucco::simulate::internal {
namespace {

TEST(PaintNoise, HasTheMeanAndDeviationItPromises) {
  double sum = 0;
  double squares = 0;
  constexpr int kSide = 400;
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      const double value = GradientNoise(0.317f * static_cast<float>(x) - 40,
                                         0.291f * static_cast<float>(y) - 50, 7);
      sum += value;
      squares += value * value;
    }
  }
  const double mean = sum / (kSide * kSide);
  EXPECT_NEAR(mean, 0, 0.03);
  EXPECT_NEAR(std::sqrt(squares / (kSide * kSide) - mean * mean), 1, 0.15);
}

TEST(PaintNoise, IsContinuousAcrossItsLattice) {
  for (const float edge : {-3.0f, 0.0f, 5.0f}) {
    EXPECT_NEAR(GradientNoise(edge - 1e-4f, 0.4f, 1), GradientNoise(edge + 1e-4f, 0.4f, 1), 5e-3);
    EXPECT_NEAR(GradientNoise(0.4f, edge - 1e-4f, 1), GradientNoise(0.4f, edge + 1e-4f, 1), 5e-3);
  }
}

TEST(PaintNoise, LeavesOutWhatTexelsCannotShow) {
  const Octaves octaves = {0.1f, 3, 0.5f, 3};
  EXPECT_EQ(Noise(0.234f, 0.567f, octaves, 0.05f), 0);
  EXPECT_NE(Noise(0.234f, 0.567f, octaves, 0.01f), 0);
  EXPECT_EQ(BandShare(0.04f, 0.01f), 1);
  EXPECT_EQ(BandShare(0.02f, 0.01f), 0);
}

TEST(PaintNoise, NormalsHaveUnitVariance) {
  double sum = 0;
  double squares = 0;
  for (int i = 0; i < 40000; ++i) {
    const double value = Normal(i % 200, i / 200, 5);
    sum += value;
    squares += value * value;
  }
  EXPECT_NEAR(sum / 40000, 0, 0.02);
  EXPECT_NEAR(squares / 40000, 1, 0.03);
}

TEST(PaintColour, TheTableOfCodesIsThatOfSrgb) {
  for (int code = 0; code < 256; ++code) {
    EXPECT_EQ(FastSrgbCode(LinearFromSrgb(static_cast<uint8_t>(code))), code);
  }
  EXPECT_EQ(FastSrgbCode(-1), 0);
  EXPECT_EQ(FastSrgbCode(7), 255);
  EXPECT_EQ(FastSrgbCode(NAN), 0);
}

TEST(PaintLibrary, EveryPictureHasWallsAndAPalette) {
  const FacadeLibrary& library = Facades();
  EXPECT_GE(library.pictures.size(), 30u);
  std::set<std::string> kinds;
  for (const FacadePicture& picture : library.pictures) {
    kinds.insert(picture.kind);
    ASSERT_FALSE(picture.walls.empty()) << picture.name;
    EXPECT_GT(picture.metres_per_px, 0.01f) << picture.name;
    EXPECT_LT(picture.metres_per_px, 0.5f) << picture.name;
    for (const Patch& patch : picture.walls) {
      EXPECT_EQ(patch.values.size(), static_cast<size_t>(patch.width) * patch.height);
    }
    const float light = Luminance(Pick(Calmed(picture.palette, 0.2f, 0.1f), 0, 0, 0));
    EXPECT_GT(light, 0.099f) << picture.name;
    EXPECT_LT(light, 0.63f) << picture.name;
  }
  for (const char* kind : {"brick", "plaster", "stone", "concrete", "panels", "glass", "membrane",
                           "gravel", "metal"}) {
    EXPECT_TRUE(kinds.contains(kind)) << kind;
    EXPECT_EQ(PictureOf(kind, -5).kind, kind);
  }
  EXPECT_GE(library.windows.size(), 20u);
  EXPECT_GE(library.shops.size(), 3u);
}

TEST(PaintLibrary, CalmedPalettesVaryNoMoreThanAsked) {
  const Palette calmed = Calmed(PictureOf("stone", 0).palette, 0.1f, 0.1f);
  const Colour& axis = calmed.axes[0];
  EXPECT_LE(std::sqrt(axis.r * axis.r + axis.g * axis.g + axis.b * axis.b), 0.1001f);
}

TEST(PaintLibrary, PatchesGoOnMirrored) {
  const Patch patch = {2, 1, {-1, 1}};
  EXPECT_EQ(At(patch, 0.5f, 0.5f), -1);
  EXPECT_EQ(At(patch, 1.5f, 0.5f), 1);
  EXPECT_EQ(At(patch, 2.5f, 0.5f), 1);
  EXPECT_EQ(At(patch, 3.5f, 7.5f), -1);
  EXPECT_EQ(At(patch, -0.5f, -3.5f), -1);
  EXPECT_NEAR(At(patch, 1.0f, 0.5f), 0, 1e-6);
}

}  // namespace
}  // namespace stucco::simulate::internal
