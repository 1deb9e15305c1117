// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>

#include "simulate/paint/internal/wall_look.h"

namespace stucco::simulate::internal {
namespace {

// What `amount` of dirt leaves of the light; dirt is brownish.
Colour Dirt(float amount) {
  const float a = std::max(0.0f, amount);
  const float left = 1 / (1 + a + 0.5f * a * a);  // nearly exp(-a), at a tenth of its cost
  return {Mix(1, left, 0.86f), Mix(1, left, 0.93f), left};
}

// How bare wall of the picture differs from place to place: two of its patches at two scales, each
// turned and shifted, so that they meet differently everywhere.
float PictureVariation(const WallLook& look, float x, float y) {
  const std::vector<Patch>& walls = look.picture->walls;
  float sum = 0;
  for (int k = 0; k < 2; ++k) {
    const uint32_t h = Hash(k, 5, look.wall);
    const Patch& patch = walls[h % walls.size()];
    const float scale = (k == 0 ? 1.0f : 2.7f) * look.picture->metres_per_px;
    const float shift = 300 * ToUnit(h * 0x9e3779b1u);
    const bool turned = (h & 0x10000) != 0;
    // Bent, so that the mirrored repeats of a small patch never line up.
    const float bend_x = 0.4f * GradientNoise(0.3f * x, 0.3f * y, h + 1);
    const float bend_y = 0.4f * GradientNoise(0.3f * x, 0.3f * y, h + 2);
    const float px = (turned ? -x - bend_x : x + bend_x) / scale + shift;
    const float py = (y + bend_y) / scale + 40 * ToUnit(h * 0x85ebca77u);
    sum += 0.35f * std::clamp(At(patch, px, py), -0.25f, 0.25f);
  }
  return sum;
}

// Rain brings down what lies on sills and copings: streaks that thin out downwards.
void Streaks(Tile& tile, const WallLook& look, const Box& box, float strength) {
  Shade(tile, box, [&](float x, float y) {
    const float down = (y - box.top) / box.Height();
    const float comb = Noise(x, 0.12f * y, {0.16f, 3, 0.8f, look.wall + 61}, tile.texel_m);
    const float edge = Smooth(0, 0.1f, x - box.left) * Smooth(0, 0.1f, box.right - x);
    return Dirt(strength * edge * (1 - down) * (1 - down) * Smooth(-0.4f, 2.0f, comb));
  });
}

}  // namespace

void Weather(Tile& tile, const WallLook& look) {
  const float texel = tile.texel_m;
  const Field picture(tile, StepFor(0.25f, texel),
                      [&](float x, float y) { return PictureVariation(look, x, y); });
  const Field stain(tile, StepFor(0.4f, texel), [&](float x, float y) {
    return Noise(x, y, {3.3f, 4, 0.6f, look.wall + 41}, texel);
  });
  const Field run(tile, StepFor(0.13f, texel), [&](float x, float y) {
    return Noise(x, 0.10f * y, {0.35f, 3, 0.8f, look.wall + 43}, texel);
  });
  const float splash_m = 0.35f + 0.5f * Trait(look, 21);
  for (int row = 0; row < tile.height; ++row) {
    const float y = tile.Y(row);
    const float up = look.height_m - y;
    const float top = std::exp(-y / 0.7f);
    for (int column = 0; column < tile.width; ++column) {
      const float s = stain(column, row);
      const float r = run(column, row);
      float dirt = look.soot * (0.10f + 0.14f * s + 0.07f * r);
      dirt += (0.2f + look.soot) * top * Smooth(-0.8f, 1.8f, r);
      dirt += (0.15f + 0.5f * look.soot) * Smooth(splash_m * (1 + 0.35f * s), 0, up);
      Colour& under = tile.At(column, row);
      under = under * Dirt(dirt) * Tone(picture(column, row) - 0.03f * s);
    }
  }
  for (const WallPart& part : look.design->parts) {
    const Box box = BoxOf(part);
    const bool sill = part.kind == PartKind::kWindow || part.kind == PartKind::kCornice ||
                      part.kind == PartKind::kBalcony;
    if (!sill) continue;
    const float length = 0.5f + 1.1f * Uniform(static_cast<int>(part.variant), 3, look.wall);
    const Box below = {box.left - 0.1f, box.bottom, box.right + 0.1f, box.bottom + length};
    if (Meet(below, tile.Extent())) Streaks(tile, look, below, 0.25f + 0.7f * look.soot);
  }
}

}  // namespace stucco::simulate::internal
