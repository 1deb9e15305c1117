// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "simulate/render/internal/mip_texture.h"
#include "survey/image.h"

namespace stucco::simulate::internal {

// What a surface shows that is finer than its texture's texels. Real surfaces have detail at every
// scale, with a power that falls with frequency (Field, "Relations between the statistics of
// natural images and the response properties of cortical cells", 1987): how much of it a texture
// has around a place in waves of four to eight texels says how much there is in shorter ones.
// Evenly coloured and glossy parts have none; edges do not count. The detail belongs to the place
// on the surface: all photos see the same.
class TextureGrain {
 public:
  TextureGrain(const Image& image, uint32_t seed);

  // What the texture's linear colour is to be multiplied by; 1 in the mean, and 1 wherever a pixel
  // covers a texel or more.
  float At(const Footprint& footprint) const;

 private:
  float StrengthAt(const Eigen::Vector2f& uv) const;

  float width_;
  float height_;
  uint32_t seed_;
  int columns_;
  int rows_;
  std::vector<uint8_t> strengths_;  // of blocks of texels, in kStrengthUnit
};

}  // namespace stucco::simulate::internal
