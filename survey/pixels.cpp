// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/pixels.h"

#include <algorithm>

namespace stucco {

ImageSize ScaledSize(ImageSize full, int max_side_px) {
  const int longer = std::max(full.width_px, full.height_px);
  if (max_side_px <= 0 || longer <= max_side_px) return full;
  const auto scaled = [&](int side) {
    const int64_t rounded = (int64_t{side} * max_side_px + longer / 2) / longer;
    return std::max(1, static_cast<int>(rounded));
  };
  return {scaled(full.width_px), scaled(full.height_px)};
}

}  // namespace stucco
