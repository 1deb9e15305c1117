// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>

#include "simulate/paint/internal/wall_look.h"

namespace stucco::simulate::internal {
namespace {

struct Block {
  int row = 0;
  int column = 0;
  Box box;
};

struct Masonry {
  float course_m = 0.35f;
  float length_m = 0.8f;
  float joint_m = 0.008f;
  float uneven = 0.2f;  // of lengths, share
};

float JointX(const Masonry& masonry, int row, int column, uint32_t seed) {
  const float jitter = masonry.uneven * (Uniform(column, row, seed + 31) - 0.5f);
  const float shift = (row & 1) != 0 ? 0.5f : 0.0f;
  return (static_cast<float>(column) + shift + jitter) * masonry.length_m;
}

Block BlockAt(const Masonry& masonry, float x, float y, uint32_t seed) {
  const int row = Floor(y / masonry.course_m);
  int column = Floor(x / masonry.length_m);
  while (JointX(masonry, row, column, seed) > x) --column;
  while (JointX(masonry, row, column + 1, seed) <= x) ++column;
  return {row,
          column,
          {JointX(masonry, row, column, seed), static_cast<float>(row) * masonry.course_m,
           JointX(masonry, row, column + 1, seed), static_cast<float>(row + 1) * masonry.course_m}};
}

Colour ColourOf(const Block& block, const WallLook& look) {
  constexpr float kSpread = 0.6f;  // blocks of one wall come from one quarry
  const auto draw = [&](int k) { return Normal(block.column, block.row, look.wall + k); };
  return Pick(look.palette, kSpread * draw(1), kSpread * draw(2), kSpread * draw(3)) *
         Tone(0.05f * draw(4));
}

}  // namespace

void PaintStone(Tile& tile, const WallLook& look) {
  const float texel = tile.texel_m;
  Masonry masonry;
  masonry.course_m = 0.28f + 0.2f * Trait(look, 1);
  masonry.length_m = masonry.course_m * (1.6f + 0.8f * Trait(look, 2));
  masonry.joint_m = 0.006f + 0.012f * Trait(look, 3);
  const bool dark_joint = Trait(look, 4) < 0.6f;
  const Colour joint = Pick(look.palette, 0, 0, 0) * (dark_joint ? 0.45f : 1.25f);
  const float grain = 0.06f * std::min(1.0f, 0.01f / texel);
  const Field cloud(tile, StepFor(0.11f, texel),
                    [&](float x, float y) { return GradientNoise(x * 9, y * 9, look.wall + 11); });
  for (int row = 0; row < tile.height; ++row) {
    const float y = tile.Y(row);
    Block block;
    Colour colour;
    float tilt = 0;
    for (int column = 0; column < tile.width; ++column) {
      const float x = tile.X(column);
      if (column == 0 || x >= block.box.right) {
        block = BlockAt(masonry, x, y, look.wall);
        colour = ColourOf(block, look);
        tilt = 3 * Normal(block.column, block.row, look.wall + 5);  // of the bedding
      }
      const uint32_t own = look.wall + Hash(block.column, block.row, 7);
      const float white = Normal(tile.x0 + column, tile.y0 + row, look.wall + 3);
      const float bed = GradientNoise(x * 3 + 100 * ToUnit(own), (y + 0.04f * tilt * x) * 14, own);
      const float pit = GradientNoise(x * 33, y * 33, own + 2) * BandShare(0.03f, texel);
      const float tone =
          0.05f * bed + 0.05f * cloud(column, row) + grain * white - 0.10f * Smooth(1, 2.2f, pit);
      const float inside = std::min(std::min(x - block.box.left, block.box.right - x),
                                    std::min(y - block.box.top, block.box.bottom - y)) -
                           masonry.joint_m / 2 + 0.003f * pit;
      const float arris = 1 - 0.10f * Smooth(0.03f, 0, inside);
      tile.At(column, row) = Mix(joint * Tone(0.2f * white * grain / 0.06f),
                                 colour * (Tone(tone) * arris), Edge(inside, texel));
    }
  }
}

}  // namespace stucco::simulate::internal
