// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "simulate/paint/internal/openings.h"

namespace stucco::simulate::internal {
namespace {

constexpr float kQuoin_m = 0.32f;  // height of a corner block

// Corner blocks, long and short in turn.
void PaintQuoins(Tile& tile, const WallLook& look, bool right) {
  const Box extent = tile.Extent();
  const int first = std::max(0, Floor(extent.top / kQuoin_m));
  for (int i = first; static_cast<float>(i) * kQuoin_m < extent.bottom; ++i) {
    const float length = (i & 1) != 0 ? 0.32f : 0.55f;
    const float top = static_cast<float>(i) * kQuoin_m;
    const Box block = {right ? look.width_m - length : 0.0f, top, right ? look.width_m : length,
                       top + kQuoin_m - 0.012f};
    if (!Meet(block, extent)) continue;
    const float tone = 0.06f * Normal(i, right ? 1 : 0, look.wall + 301);
    Fill(tile, block, [&](float x, float y, Colour) {
      const float edge = std::min(std::min(x - block.left, block.right - x),
                                  std::min(y - block.top, block.bottom - y));
      const float wear = 0.05f * Noise(x, y, {0.4f, 5, 0.75f, look.wall + 303}, tile.texel_m);
      return look.surround * (Tone(tone + wear) * (1 - 0.3f * Edge(0.012f - edge, tile.texel_m)));
    });
  }
}

Box BandAt(const WallLook& look, float y) {
  return {0, y - 0.16f, look.width_m, y};
}

void PaintBand(Tile& tile, const WallLook& look, const Box& band) {
  if (!Meet({band.left, band.top, band.right, band.bottom + 0.1f}, tile.Extent())) return;
  Fill(tile, band, [&](float x, float py, Colour) {
    const float v = (py - band.top) / band.Height();
    const float wear = 0.05f * Noise(x, py, {0.5f, 4, 0.7f, look.wall + 305}, tile.texel_m);
    return look.surround * Tone(wear + 0.12f * Smooth(0.3f, 0, v) - 0.25f * Smooth(0.75f, 1, v));
  });
  Shade(tile, {band.left, band.bottom, band.right, band.bottom + 0.1f},
        [&](float, float py) { return 0.6f + 0.4f * Smooth(0, 0.1f, py - band.bottom); });
}

bool MeetsCornice(const WallLook& look, const Box& box) {
  const std::vector<WallPart>& parts = look.design->parts;
  return std::any_of(parts.begin(), parts.end(), [&](const WallPart& part) {
    return part.kind == PartKind::kCornice && Meet(BoxOf(part), box);
  });
}

}  // namespace

void PaintOrnament(Tile& tile, const WallLook& look) {
  if (!look.surrounds || look.design->cladding == Cladding::kConcrete) return;
  if (Trait(look, 61) < 0.45f && look.width_m > 4) {
    PaintQuoins(tile, look, false);
    PaintQuoins(tile, look, true);
  }
  if (Trait(look, 62) < 0.5f) {
    for (const double floor : look.design->floors_m) {
      const Box band = BandAt(look, static_cast<float>(floor));
      if (!MeetsCornice(look, band)) PaintBand(tile, look, band);
    }
  }
}

}  // namespace stucco::simulate::internal
