// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace stucco {

// 8-bit pixels, rows without padding, channels interleaved (1 = grey, 3 = R G B).
struct Image {
  int width_px = 0;
  int height_px = 0;
  int channels = 3;
  std::vector<uint8_t> data;

  const uint8_t* Pixel(int x, int y) const {
    return data.data() + (static_cast<size_t>(y) * width_px + x) * channels;
  }
  uint8_t* Pixel(int x, int y) {
    return data.data() + (static_cast<size_t>(y) * width_px + x) * channels;
  }
};

struct ImageSize {
  int width_px = 0;
  int height_px = 0;
};

// The size of a picture limited to `max_side_px` (0: no limit), at least 1 x 1.
ImageSize ScaledSize(ImageSize full, int max_side_px);

}  // namespace stucco
