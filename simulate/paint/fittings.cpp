// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>

#include "simulate/paint/internal/openings.h"

namespace stucco::simulate::internal {
namespace {

// Whether a box lies on the wall and touches no part. Pipes go on behind a cornice.
bool IsFree(const WallLook& look, const Box& box, bool behind_cornice = false) {
  if (box.left < 0 || box.top < 0 || box.right > look.width_m || box.bottom > look.height_m) {
    return false;
  }
  for (const WallPart& part : look.design->parts) {
    Box its = BoxOf(part);
    if (part.kind == PartKind::kWindow) {
      const float more = look.shutters ? its.Width() / 2 : 0.0f;
      its = {its.left - more - 0.2f, its.top - 0.3f, its.right + more + 0.2f, its.bottom + 0.2f};
    }
    const bool below =
        part.kind == PartKind::kPlinth || (behind_cornice && part.kind == PartKind::kCornice);
    if (!below && Meet(its, box)) return false;
  }
  return true;
}

void PaintPipe(Tile& tile, const WallLook& look, float x) {
  const Box pipe = {x - 0.055f, 0, x + 0.055f, look.height_m};
  const Colour zinc = Trait(look, 51) < 0.6f ? FromSrgb(126, 130, 132) : FromSrgb(104, 66, 44);
  Shade(tile, {pipe.right, 0, pipe.right + 0.05f, look.height_m},
        [](float, float) { return 0.72f; });
  Fill(tile, pipe, [&](float px, float y, Colour) {
    const float round = (px - x) / 0.055f;
    const float wear = 0.10f * Noise(px, 0.3f * y, {0.4f, 5, 0.7f, look.wall + 55}, tile.texel_m);
    const float clamp = y - 2.1f * static_cast<float>(Floor(y / 2.1f));
    const float ring = 0.3f * Edge(0.02f - std::abs(clamp - 1.0f), tile.texel_m);
    return zinc * Tone(0.25f - 0.75f * round * round - 0.15f * round + wear - ring);
  });
}

void PaintVent(Tile& tile, const Box& box, uint32_t seed) {
  const Colour colour = (seed & 1) != 0 ? Grey(0.5f) : Grey(0.25f);
  Fill(tile, box, [&](float, float y, Colour) {
    const float slat = y * 40 - static_cast<float>(Floor(y * 40));
    return colour * Mix(0.55f, slat < 0.5f ? 0.2f : 1.0f, BandShare(0.025f, tile.texel_m));
  });
  PaintFrame(tile, box, 0.02f, colour, seed);
}

void PaintPoster(Tile& tile, const Box& box, uint32_t seed) {
  const Colour paper =
      Mix(FromSrgb(228, 222, 206),
          FromSrgb((seed >> 3) & 255, (seed >> 9) & 255, (seed >> 15) & 255), 0.6f);
  const Colour ink = Luminance(paper) > 0.25f ? Grey(0.04f) : Grey(0.7f);
  Fill(tile, box, [&](float x, float y, Colour) {
    const float blot = GradientNoise(x * 4, y * 4, seed);
    return Mix(paper, ink, 0.5f * Smooth(0.8f, 1.0f, blot)) *
           Tone(0.05f * Noise(x, y, {0.2f, 4, 0.7f, seed + 1}, tile.texel_m));
  });
  const float line = box.Height() / 9;
  for (int i = 0; i < 4; ++i) {
    const float top = box.top + line * (1 + 2 * static_cast<float>(i));
    PaintLetters(tile, {box.left + 0.05f, top, box.right - 0.05f, top + line}, ink, seed + i);
  }
}

void PaintLamp(Tile& tile, float x, float y, uint32_t seed) {
  PaintBar(tile, {x - 0.06f, y - 0.12f, x + 0.06f, y + 0.12f}, Grey(0.06f), seed);
  PaintBar(tile, {x - 0.04f, y - 0.07f, x + 0.04f, y + 0.09f}, FromSrgb(230, 222, 196), seed);
}

void PaintScrawl(Tile& tile, const Box& box, uint32_t seed) {
  const Colour paint = FromSrgb((seed >> 4) & 255, (seed >> 10) & 127, 60 + ((seed >> 16) & 127));
  Fill(tile, box, [&](float x, float y, Colour under) {
    const float u = (x - box.left) / box.Width();
    const float v = (y - box.top) / box.Height();
    const float level = Noise(x, y, {0.7f, 2, 0.4f, seed}, tile.texel_m);
    const float inside = std::min(std::min(u, 1 - u), std::min(v, 1 - v));
    const float share =
        Edge(0.03f - std::abs(level) * 0.1f, tile.texel_m) * Smooth(0.02f, 0.15f, inside);
    return Mix(under, paint, 0.85f * share);
  });
}

void PaintSmallThings(Tile& tile, const WallLook& look) {
  const int count = 2 + static_cast<int>(look.width_m / 3);
  for (int i = 0; i < count; ++i) {
    const auto draw = [&](int k) { return Uniform(i, k, look.wall + 200); };
    const uint32_t seed = Hash(i, 1, look.wall + 201);
    const float x = draw(0) * look.width_m;
    const float kind = draw(1);
    if (kind < 0.4f) {
      const float size = 0.14f + 0.2f * draw(2);
      const float y = draw(3) * look.height_m;
      const Box box = {x, y, x + size, y + size};
      if (IsFree(look, box)) PaintVent(tile, box, seed);
    } else if (kind < 0.6f) {
      const float y = look.height_m - 1.1f - 0.6f * draw(2);
      const Box box = {x, y - 0.7f, x + 0.5f, y};
      if (look.soot > 0.15f && IsFree(look, box)) PaintPoster(tile, box, seed);
    } else if (kind < 0.8f) {
      const float y = look.height_m - 2.5f;
      if (IsFree(look, {x - 0.1f, y - 0.2f, x + 0.1f, y + 0.2f})) PaintLamp(tile, x, y, seed);
    } else if (kind < 0.9f) {
      const Box box = {x, look.height_m - 1.6f, x + 2.2f, look.height_m - 0.5f};
      if (look.soot > 0.3f && IsFree(look, box)) PaintScrawl(tile, box, seed);
    } else {
      const Box plate = {x, look.height_m - 2.2f, x + 0.2f, look.height_m - 2.05f};
      if (!IsFree(look, plate)) continue;
      PaintBar(tile, plate, FromSrgb(30, 60, 120), seed);
      PaintLetters(tile, Inset(plate, 0.035f), Grey(0.8f), seed);
    }
  }
}

// A cable along a floor line, sagging between its clips.
void PaintCable(Tile& tile, const WallLook& look, float y0) {
  Fill(tile, {0, y0 - 0.05f, look.width_m, y0 + 0.1f}, [&](float x, float y, Colour under) {
    const float span = x / 1.7f - static_cast<float>(Floor(x / 1.7f)) - 0.5f;
    const float line = y0 + 0.03f * (0.25f - span * span) * 4;
    const Colour black = Grey(0.03f);
    return Mix(under, black, 0.9f * Edge(0.007f - std::abs(y - line), tile.texel_m));
  });
}

}  // namespace

void PaintFittings(Tile& tile, const WallLook& look) {
  if (look.design->cladding == Cladding::kGlass) return;
  if (look.width_m > 2 && look.height_m > 2) {
    PaintSmallThings(tile, look);
    const float pipe_x = Uniform(1, 1, look.wall + 210) < 0.5f ? 0.18f : look.width_m - 0.18f;
    if (Trait(look, 52) < 0.6f &&
        IsFree(look, {pipe_x - 0.08f, 0, pipe_x + 0.08f, look.height_m}, /*behind_cornice=*/true)) {
      PaintPipe(tile, look, pipe_x);
    }
    if (look.soot > 0.25f && !look.design->floors_m.empty()) {
      const float y = static_cast<float>(look.design->floors_m.front()) + 0.1f;
      if (IsFree(look, {0.01f, y - 0.05f, look.width_m - 0.01f, y + 0.1f})) {
        PaintCable(tile, look, y);
      }
    }
  }
}

}  // namespace stucco::simulate::internal
