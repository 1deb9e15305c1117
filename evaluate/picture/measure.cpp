// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "evaluate/picture/measure.h"

#include "evaluate/picture/structure.h"

namespace stucco::evaluate {

MeasuredPair MeasurePair(const PicturePair& pair, const Lpips* lpips) {
  MeasuredPair measured;
  measured.flip = Flip(pair);
  measured.figures = {.ssim = Ssim(pair),
                      .ms_ssim = MultiScaleSsim(pair),
                      .psnr = Psnr(pair),
                      .gmsd = Gmsd(pair),
                      .flip = MeanError(measured.flip),
                      .lpips = lpips != nullptr ? lpips->Distance(pair) : kNotMeasured};
  return measured;
}

}  // namespace stucco::evaluate
