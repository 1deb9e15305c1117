// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "evaluate/figures/means.h"

#include <cmath>
#include <vector>

namespace stucco::evaluate {
namespace {

// `Weighted` has figures and a weight.
template <typename Weighted, typename Figures>
double MeanOf(std::span<const Weighted> all, double Figures::*measure) {
  double sum = 0;
  double weight = 0;
  for (const Weighted& one : all) {
    const double value = one.figures.*measure;
    if (!std::isnan(value)) {
      sum += one.weight * value;
      weight += one.weight;
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

Likeness MeanLikeness(std::span<const WeightedLikeness> all) {
  return {.ssim = MeanOf(all, &Likeness::ssim),
          .psnr = MeanOf(all, &Likeness::psnr),
          .shift_m = MeanOf(all, &Likeness::shift_m)};
}

LikenessOfPart MeanPart(std::span<const WeightedPart> all) {
  std::vector<WeightedLikeness> results;
  std::vector<WeightedLikeness> ceilings;
  for (const WeightedPart& one : all) {
    const double weight = one.figures.share > 0 ? one.weight * one.figures.share : 0;
    results.push_back({one.figures.result, weight});
    ceilings.push_back({one.figures.ceiling, weight});
  }
  return {.share = MeanOf(all, &LikenessOfPart::share),
          .result = MeanLikeness(results),
          .ceiling = MeanLikeness(ceilings)};
}

}  // namespace stucco::evaluate
