// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstdint>
#include <vector>

#include "survey/image.h"

namespace stucco::simulate::internal {

// Where a texture is opaque (alpha at least one half), a bit per texel: a leaf's fits into the
// fastest cache.
class AlphaMask {
 public:
  AlphaMask(const Image& image, bool repeats)
      : width_(image.width_px), height_(image.height_px), repeats_(repeats) {
    bits_.assign((static_cast<size_t>(width_) * height_ + 63) / 64, 0);
    for (size_t i = 0; i < static_cast<size_t>(width_) * height_; ++i) {
      const bool opaque = image.channels != 4 || image.data[4 * i + 3] >= 128;
      if (opaque) bits_[i / 64] |= uint64_t{1} << (i % 64);
    }
  }

  bool IsOpaque(const Eigen::Vector2f& uv) const {
    const size_t i = static_cast<size_t>(At(uv.y(), height_)) * width_ + At(uv.x(), width_);
    return bits_[i / 64] >> (i % 64) & 1;
  }

 private:
  int At(float share, int size) const {
    // Not by std::floor, a call on processors of 2003; far beyond the picture precision is gone.
    constexpr float kFar = 1e6f;
    if (!(share > -kFar && share < kFar)) return 0;
    if (repeats_) {
      const auto whole = static_cast<float>(static_cast<int>(share));
      share -= share < whole ? whole - 1 : whole;
    }
    return std::clamp(static_cast<int>(share * static_cast<float>(size)), 0, size - 1);
  }

  int width_;
  int height_;
  bool repeats_;
  std::vector<uint64_t> bits_;
};

}  // namespace stucco::simulate::internal
