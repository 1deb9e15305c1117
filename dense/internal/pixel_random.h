// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

namespace stucco {

// Random numbers of a pixel's own, the same whatever order pixels are worked on in: PCG hash
// (Jarzynski & Olano, "Hash functions for GPU rendering", 2020).
class PixelRandom {
 public:
  PixelRandom(uint32_t seed, uint32_t pixel, uint32_t round) : state_(seed * 747796405u + pixel) {
    state_ = Next() + round * 2891336453u;
    Next();
  }
  uint32_t Next() {
    state_ = state_ * 747796405u + 2891336453u;
    const uint32_t word = ((state_ >> ((state_ >> 28u) + 4u)) ^ state_) * 277803737u;
    return (word >> 22u) ^ word;
  }
  float Uniform(float low, float high) {
    return low + (high - low) * static_cast<float>(Next() >> 8) * 0x1p-24f;
  }

 private:
  uint32_t state_;
};

}  // namespace stucco
