// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "evaluate/figures/evaluation.h"
#include "evaluate/picture/picture_pair.h"

namespace stucco::evaluate {

// SSIM, PSNR and shift of a pair, whose pixels are `texel_m` wide.
Likeness LikenessOf(const PicturePair& pair, double texel_m);

// The texels of a wall by what the scene has there.
struct WallParts {
  std::vector<uint8_t> plane;         // the wall's own plane
  std::vector<uint8_t> relief;        // what stands out or lies back, and the rim around it
  double plane_share = kNotMeasured;  // of the texels in the mask
};

// `heights_m` are metres before the wall's plane by texel, NaN where there is nothing; within 2 cm
// of the plane a texel is on it. What is neither in `mask` nor known is in no part. The rim is as
// wide as a window of SSIM, so that each window that touches relief is in that part as a whole.
WallParts PartsOfWall(std::span<const float> heights_m, const std::vector<uint8_t>& mask,
                      ImageSize size);

}  // namespace stucco::evaluate
