// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "survey/image.h"

namespace stucco::simulate::internal {

// What a pixel covers of a texture: its centre and how far it moves for one pixel to the right and
// one down, all in uv.
struct Footprint {
  Eigen::Vector2f centre = Eigen::Vector2f::Zero();
  Eigen::Vector2f right = Eigen::Vector2f::Zero();
  Eigen::Vector2f down = Eigen::Vector2f::Zero();
};

// The longer half axis, in texels of a picture of this size, of the ellipse that a footprint is
// when the pixel is a circle of radius 1.
float LongerAxis(const Footprint& footprint, float width, float height);

// A picture with its halved copies (Williams, "Pyramidal parametrics", SIGGRAPH 1983), averaged in
// linear light. Texel (c, r) of level l covers the texels c 2^l ... (c + 1) 2^l - 1 of the picture,
// as far as there are any, so that nothing shifts where a side is no power of two. Texels lie in
// tiles of 4 x 4, one cache line each: a pixel's neighbourhood costs one or two lines whatever the
// direction in which it runs over the picture.
class MipTexture {
 public:
  // `repeats` false: beyond the border the border's texels go on.
  MipTexture(const Image& image, bool repeats);

  // Linear colour and alpha, averaged over a footprint: trilinear probes along its longer axis
  // (McCormack et al., "Feline: fast elliptical lines for anisotropic texture mapping", 1999).
  Eigen::Array4f Sample(const Footprint& footprint) const;
  Eigen::Array3f Mean() const;  // linear

 private:
  struct Level {
    int width = 0;
    int height = 0;
    int tiles_across = 0;
    size_t first = 0;  // index of its first texel
  };

  void AppendLevel(int width, int height);
  void FillBase(const Image& image);
  uint32_t MeanOfFiner(const Level& finer, int finer_number, int x, int y) const;
  void FillFromFiner(size_t level);
  uint32_t& Texel(const Level& level, int x, int y);
  uint32_t Texel(const Level& level, int x, int y) const;
  Eigen::Array4f Bilinear(const Level& level, float x, float y) const;
  Eigen::Array4f Trilinear(float x, float y, float lod) const;

  bool repeats_;
  std::vector<Level> levels_;
  std::vector<uint32_t> texels_;  // R, G, B, A from the lowest byte on; sRGB
};

}  // namespace stucco::simulate::internal
