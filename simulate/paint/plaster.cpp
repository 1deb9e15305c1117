// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>

#include "simulate/paint/internal/cracks.h"
#include "simulate/paint/internal/wall_look.h"

namespace stucco::simulate::internal {
namespace {

// Repairs: at most one in a square of this size, a few of them filled.
constexpr float kRepairCell_m = 3.1f;

struct Repair {
  Box box;
  float tone = 0;
};

Repair RepairAt(const WallLook& look, int cell_x, int cell_y) {
  const auto draw = [&](int k) { return Uniform(cell_x, cell_y, look.wall + 400 + k); };
  if (draw(0) > 0.16f * (0.4f + look.soot)) return {};
  const float left = (static_cast<float>(cell_x) + 0.1f + 0.4f * draw(1)) * kRepairCell_m;
  const float top = (static_cast<float>(cell_y) + 0.1f + 0.4f * draw(2)) * kRepairCell_m;
  return {{left, top, left + 0.3f + 1.1f * draw(3), top + 0.2f + 0.9f * draw(4)},
          0.35f * (draw(5) - 0.4f)};
}

void PaintRepairs(Tile& tile, const WallLook& look) {
  const Box extent = tile.Extent();
  for (int cell_y = Floor(extent.top / kRepairCell_m); cell_y * kRepairCell_m < extent.bottom;
       ++cell_y) {
    for (int cell_x = Floor(extent.left / kRepairCell_m); cell_x * kRepairCell_m < extent.right;
         ++cell_x) {
      const Repair repair = RepairAt(look, cell_x, cell_y);
      if (!Meet(repair.box, extent)) continue;
      const Box box = repair.box;
      Shade(tile, box, [&](float x, float y) {
        const float ragged = 0.04f * Noise(x, y, {0.3f, 4, 0.6f, look.wall + 17}, tile.texel_m);
        const float inside =
            std::min(std::min(x - box.left, box.right - x), std::min(y - box.top, box.bottom - y));
        const float share = Edge(inside - 0.08f + ragged, tile.texel_m);
        const float rim = 0.12f * Edge(0.012f - std::abs(inside - 0.08f + ragged), tile.texel_m);
        return (1 + repair.tone * share) * (1 - rim);
      });
    }
  }
}

}  // namespace

void PaintPlaster(Tile& tile, const WallLook& look) {
  const float texel = tile.texel_m;
  const Colour base = Pick(look.palette, 0.5f * (Trait(look, 1) - 0.5f), 2 * Trait(look, 2) - 1,
                           2 * Trait(look, 3) - 1);
  const Field trowel(tile, StepFor(0.2f, texel), [&](float x, float y) {
    return Noise(x, y, {0.8f, 3, 0.75f, look.wall + 5}, texel);
  });
  const Field cracked(tile, StepFor(0.5f, texel), [&](float x, float y) {
    return Noise(x, y, {4.0f, 3, 0.5f, look.wall + 6}, texel);
  });
  const Field bend(tile, StepFor(0.2f, texel), [&](float x, float y) {
    return Noise(x, y, {1.3f, 3, 0.55f, look.wall + 10}, texel);
  });
  const Cracks cracks = {0.6f, 0.166f, {0.16f, 2, 0.55f, look.wall + 9}, 0.0035f, texel};
  const float coarse = Trait(look, 4);  // of the render's sand
  const float grain = (0.035f + 0.07f * coarse) * std::min(1.0f, 0.01f / texel);
  for (int row = 0; row < tile.height; ++row) {
    const float y = tile.Y(row);
    for (int column = 0; column < tile.width; ++column) {
      const float x = tile.X(column);
      const float white = Normal(tile.x0 + column, tile.y0 + row, look.wall + 3);
      float tone = 0.035f * trowel(column, row) + grain * white +
                   (0.02f + 0.03f * coarse) * GradientNoise(x * 30, y * 30, look.wall + 8) *
                       BandShare(0.033f, texel);
      const float open = Smooth(0.6f, 1.6f, cracked(column, row) + look.soot);
      tone -= 0.45f * CrackShare(cracks, x, y, bend(column, row), open);
      tile.At(column, row) = base * Tone(tone);
    }
  }
  PaintRepairs(tile, look);
}

}  // namespace stucco::simulate::internal
