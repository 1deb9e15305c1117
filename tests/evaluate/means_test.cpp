// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "evaluate/figures/means.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace stucco::evaluate {
namespace {

TEST(MeanFigures, WeighsAndLeavesOutWhatWasNotMeasured) {
  std::vector<WeightedPicture> pictures(3);
  pictures[0] = {{.ssim = 0.5, .psnr = 20}, 3};
  pictures[1] = {{.ssim = 0.9}, 1};
  pictures[2] = {{.psnr = 30}, 1};
  const PictureFigures mean = MeanFigures(pictures);
  EXPECT_DOUBLE_EQ(mean.ssim, 0.6);
  EXPECT_DOUBLE_EQ(mean.psnr, 22.5);
  EXPECT_TRUE(std::isnan(mean.flip));
}

TEST(MeanFigures, NothingGivesNothing) {
  EXPECT_TRUE(std::isnan(MeanFigures({}).ssim));
}

TEST(MeanPart, WeighsByTheSharesOfTheParts) {
  const std::vector<WeightedPart> parts = {
      {{.share = 0.5, .result = {.ssim = 0.4, .psnr = 20, .shift_m = 1}, .ceiling = {}}, 10},
      {{.share = 0.25, .result = {.ssim = 0.8, .psnr = kNotMeasured, .shift_m = 2}, .ceiling = {}},
       20},
      {{}, 100}};
  const LikenessOfPart mean = MeanPart(parts);
  EXPECT_NEAR(mean.share, 1.0 / 3, 1e-12);
  EXPECT_NEAR(mean.result.ssim, 0.6, 1e-12);
  EXPECT_NEAR(mean.result.psnr, 20, 1e-12);
  EXPECT_NEAR(mean.result.shift_m, 1.5, 1e-12);
  EXPECT_TRUE(std::isnan(mean.ceiling.ssim));
}

}  // namespace
}  // namespace stucco::evaluate
