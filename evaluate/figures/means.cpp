// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "evaluate/figures/means.h"

#include <cmath>

namespace stucco::evaluate {
namespace {

double MeanOf(std::span<const WeightedPicture> pictures, double PictureFigures::*measure) {
  double sum = 0;
  double weight = 0;
  for (const WeightedPicture& picture : pictures) {
    const double value = picture.figures.*measure;
    if (!std::isnan(value)) {
      sum += picture.weight * value;
      weight += picture.weight;
    }
  }
  return weight > 0 ? sum / weight : kNotMeasured;
}

}  // namespace

PictureFigures MeanFigures(std::span<const WeightedPicture> pictures) {
  return {.ssim = MeanOf(pictures, &PictureFigures::ssim),
          .ms_ssim = MeanOf(pictures, &PictureFigures::ms_ssim),
          .psnr = MeanOf(pictures, &PictureFigures::psnr),
          .gmsd = MeanOf(pictures, &PictureFigures::gmsd),
          .flip = MeanOf(pictures, &PictureFigures::flip),
          .lpips = MeanOf(pictures, &PictureFigures::lpips)};
}

}  // namespace stucco::evaluate
