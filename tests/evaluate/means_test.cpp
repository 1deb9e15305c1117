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

}  // namespace
}  // namespace stucco::evaluate
