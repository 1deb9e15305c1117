// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>

#include "simulate/paint/internal/openings.h"

namespace stucco::simulate::internal {
namespace {

float Draw(const WallPart& part, const WallLook& look, int which) {
  return Uniform(static_cast<int>(part.variant), 1000 + which, look.wall);
}

Colour Fabric(float choice) {
  if (choice < 0.5f) return FromSrgb(224, 220, 208);
  if (choice < 0.65f) return FromSrgb(196, 178, 140);
  if (choice < 0.75f) return FromSrgb(140, 62, 54);
  if (choice < 0.85f) return FromSrgb(92, 110, 140);
  return FromSrgb(120, 132, 96);
}

// Pleats fall unevenly: a wave whose phase wanders.
float Pleats(float x, float y, uint32_t seed, float texel_m) {
  const float wander = 0.9f * Noise(x, 0.15f * y, {0.4f, 2, 0.5f, seed}, texel_m);
  return std::sin(x * 62 + 2.5f * wander) * BandShare(0.1f, texel_m);
}

// The room: what a picture of the library shows behind a pane, darker at the top, where the lintel
// keeps the sky out.
Colour Room(const Box& glass, float x, float y, uint32_t seed) {
  const std::vector<Pane>& rooms = Facades().windows;
  const float u = (x - glass.left) / glass.Width();
  const float v = (y - glass.top) / glass.Height();
  const Colour seen = At(rooms[seed % rooms.size()], (seed & 64) != 0 ? 1 - u : u, v);
  const Colour pale = Mix(seen, Grey(Luminance(seen)), 0.4f);  // most of its hue is the sky's
  const Colour dim = pale * (0.25f + 0.5f * ToUnit(seed * 0x9e3779b1u));
  // What stands in the room: backs of chairs, shelves, pictures, a lamp.
  constexpr float kThing_m = 0.34f;
  const int cx = Floor(x / kThing_m);
  const int cy = Floor(y / kThing_m);
  const uint32_t h = Hash(cx, cy, seed);
  const float in_x = std::abs(x / kThing_m - static_cast<float>(cx) - 0.5f);
  const float in_y = std::abs(y / kThing_m - static_cast<float>(cy) - 0.5f);
  const bool there = (h & 3) < 2 && in_x < 0.15f + 0.35f * ToUnit(h * 0x85ebca77u) &&
                     in_y < 0.15f + 0.35f * ToUnit(h * 0xc2b2ae3du);
  const float thing = there ? 0.35f + 1.3f * ToUnit(h) : 1.0f;
  return dim * (thing * (0.55f + 0.45f * Smooth(0, 0.35f, v)));
}

struct Layer {
  Colour colour;
  float share;  // of what it covers
};

Layer Plant(const Box& glass, float x, float y, uint32_t seed, float texel_m) {
  const float up = (glass.bottom - y) / 0.45f;
  const float leaves = Noise(x, y, {0.14f, 4, 0.8f, seed}, texel_m) + 1.1f - 1.9f * up;
  const float share = Smooth(0.0f, 0.15f, leaves);
  const float light = 0.06f + 0.05f * Noise(x, y, {0.05f, 2, 0.8f, seed + 3}, texel_m);
  return {Colour{0.5f, 1.0f, 0.25f} * std::max(0.01f, light), share};
}

}  // namespace

void PaintGlass(Tile& tile, const WallLook& look, const WallPart& part, const Box& glass) {
  const float texel = tile.texel_m;
  const uint32_t seed = Hash(part.variant, 3, look.wall);
  const float kind = Draw(part, look, 1);
  const Colour fabric = Fabric(Draw(part, look, 2));
  const float mirror = 0.10f + 0.25f * Draw(part, look, 3);
  const float left_m = glass.Width() * (0.12f + 0.3f * Draw(part, look, 4));
  const float right_m = glass.Width() * (0.12f + 0.3f * Draw(part, look, 5));
  const float drop_m = glass.Height() * Draw(part, look, 6);
  const bool plant = Draw(part, look, 7) < 0.18f;
  const float offset = 9 * Draw(part, look, 8);
  Fill(tile, glass, [&](float x, float y, Colour) {
    Colour seen = Room(glass, x, y, seed);
    if (kind < 0.35f) {  // curtains drawn aside
      const float sway = 0.03f * GradientNoise(0.5f, y * 1.5f, seed + 4);
      const float cloth = std::max(Edge(glass.left + left_m + sway - x, texel),
                                   Edge(x - glass.right + right_m + sway, texel));
      const float pleats = Pleats(x, y, seed, texel);
      seen = Mix(seen, fabric * (0.42f + 0.16f * pleats), cloth);
    } else if (kind < 0.5f) {  // net curtain
      seen = Mix(seen, fabric * (0.5f + 0.08f * Pleats(x, y, seed, texel)), 0.62f);
    } else if (kind < 0.66f) {  // venetian blind
      const float pitch = y * 33;
      const float slat = pitch - static_cast<float>(Floor(pitch));
      const float light =
          Mix(0.40f, 0.18f + 0.5f * Smooth(0.1f, 0.7f, slat), BandShare(0.03f, texel));
      seen = Mix(seen, fabric * light, Edge(glass.top + drop_m - y, texel));
    } else if (kind < 0.78f) {  // roller blind
      seen = Mix(seen, fabric * (0.5f + 0.02f * GradientNoise(x * 4, y * 4, seed)),
                 Edge(glass.top + drop_m - y, texel));
    }
    if (plant) {
      const Layer leaves = Plant(glass, x, y, seed, texel);
      seen = Mix(seen, leaves.colour, leaves.share);
    }
    const Colour sky = Mirrored(x * 1.1f + offset, y, look.height_m * 0.75f, look.building + 9);
    return Mix(seen, sky, mirror);
  });
  // The reveal shades the pane at its top and one side.
  Shade(tile, glass, [&](float x, float y) {
    return Grey((0.45f + 0.55f * Smooth(0, 0.16f, y - glass.top)) *
                (0.8f + 0.2f * Smooth(0, 0.05f, x - glass.left)));
  });
}

void PaintBar(Tile& tile, const Box& bar, Colour colour, uint32_t seed) {
  Fill(tile, bar, [&](float x, float y, Colour) {
    const float edge =
        std::min(std::min(x - bar.left, bar.right - x), std::min(y - bar.top, bar.bottom - y));
    const float wear = 0.025f * Noise(x, y, {0.12f, 3, 0.7f, seed}, tile.texel_m);
    const float lit = y - bar.top < bar.bottom - y ? 0.08f : -0.12f;  // upper edges catch light
    return colour * Tone(wear + lit * Edge(0.008f - edge, tile.texel_m));
  });
}

void PaintFrame(Tile& tile, const Box& box, float bar_m, Colour colour, uint32_t seed) {
  PaintBar(tile, {box.left, box.top, box.left + bar_m, box.bottom}, colour, seed);
  PaintBar(tile, {box.right - bar_m, box.top, box.right, box.bottom}, colour, seed + 1);
  PaintBar(tile, {box.left, box.top, box.right, box.top + bar_m}, colour, seed + 2);
  PaintBar(tile, {box.left, box.bottom - bar_m, box.right, box.bottom}, colour, seed + 3);
}

namespace {

void Muntins(Tile& tile, const Box& box, int columns, int rows, const Colour& colour) {
  constexpr float kBar_m = 0.028f;
  for (int i = 1; i < columns; ++i) {
    const float x = Mix(box.left, box.right, static_cast<float>(i) / static_cast<float>(columns));
    PaintBar(tile, {x - kBar_m / 2, box.top, x + kBar_m / 2, box.bottom}, colour, 5 + i);
  }
  for (int i = 1; i < rows; ++i) {
    const float y = Mix(box.top, box.bottom, static_cast<float>(i) / static_cast<float>(rows));
    PaintBar(tile, {box.left, y - kBar_m / 2, box.right, y + kBar_m / 2}, colour, 15 + i);
  }
}

void Divide(Tile& tile, const WallLook& look, const Box& inner, Colour frame, uint32_t seed) {
  const float middle = (inner.left + inner.right) / 2;
  const float transom = inner.top + inner.Height() * (look.window_style == 1 ? 0.5f : 0.3f);
  constexpr float kLeaf_m = 0.05f;
  if (inner.Width() < 0.35f || inner.Height() < 0.35f) return;
  switch (look.window_style) {
    case 0:  // two leaves and a light above
      PaintBar(tile, {middle - 0.045f, inner.top, middle + 0.045f, inner.bottom}, frame, seed);
      PaintBar(tile, {inner.left, transom - 0.035f, inner.right, transom + 0.035f}, frame, seed);
      break;
    case 1:  // sash, with small panes
      Muntins(tile, inner, inner.Width() > 0.9f ? 3 : 2, 4, frame);
      PaintBar(tile, {inner.left, transom - 0.03f, inner.right, transom + 0.03f}, frame, seed);
      break;
    case 2:  // two leaves
      PaintBar(tile, {middle - 0.05f, inner.top, middle + 0.05f, inner.bottom}, frame, seed);
      break;
    case 3:  // leaves that open, each with its own frame
      PaintFrame(tile, {inner.left, inner.top, middle, inner.bottom}, kLeaf_m, frame, seed);
      PaintFrame(tile, {middle, inner.top, inner.right, inner.bottom}, kLeaf_m, frame, seed + 4);
      break;
    default:  // one pane, or a wide one with a narrow leaf
      if (inner.Width() > 1.3f) {
        const float x = inner.left + inner.Width() * 0.33f;
        PaintBar(tile, {x - 0.04f, inner.top, x + 0.04f, inner.bottom}, frame, seed);
      }
  }
}

}  // namespace

void PaintSurround(Tile& tile, const WallLook& look, const Box& box) {
  const float band = 0.10f + 0.08f * Trait(look, 41);
  const Box outer = {box.left - band, box.top - band * 1.3f, box.right + band, box.bottom};
  const uint32_t seed = look.wall + 71;
  Fill(tile, outer, [&](float x, float y, Colour) {
    const float edge = std::min(std::min(x - outer.left, outer.right - x), y - outer.top);
    const float wear = 0.05f * Noise(x, y, {0.4f, 4, 0.7f, seed}, tile.texel_m);
    return look.surround * Tone(wear - 0.25f * Edge(0.010f - edge, tile.texel_m));
  });
  Shade(tile, {outer.left, box.bottom, outer.right, box.bottom + 0.02f},
        [](float, float) { return 0.8f; });
}

void PaintSill(Tile& tile, const WallLook& look, const Box& box) {
  const Box sill = {box.left - 0.07f, box.bottom - 0.03f, box.right + 0.07f, box.bottom + 0.05f};
  PaintBar(tile, sill, look.surround * 0.9f, look.wall + 81);
  Shade(tile, {sill.left, sill.bottom, sill.right, sill.bottom + 0.09f},
        [&](float, float y) { return 0.55f + 0.45f * Smooth(0, 0.09f, y - sill.bottom); });
}

void PaintShutter(Tile& tile, const WallLook& look, const Box& leaf) {
  const float texel = tile.texel_m;
  Fill(tile, leaf, [&](float x, float y, Colour) {
    const float pitch = y * 22;
    const float slat = pitch - static_cast<float>(Floor(pitch));
    const float edge =
        std::min(std::min(x - leaf.left, leaf.right - x), std::min(y - leaf.top, leaf.bottom - y));
    const float wear = 0.10f * Noise(x, y, {0.2f, 3, 0.7f, look.wall + 83}, texel);
    const float light =
        edge < 0.06f ? 1.05f
                     : Mix(0.8f, 0.5f + 0.6f * Smooth(0, 0.8f, slat), BandShare(0.045f, texel));
    return look.shutter * (Tone(wear) * light);
  });
  Shade(tile, {leaf.right, leaf.top + 0.03f, leaf.right + 0.03f, leaf.bottom + 0.03f},
        [](float, float) { return 0.7f; });
}

void PaintWindow(Tile& tile, const WallLook& look, const WallPart& part) {
  const Box box = BoxOf(part);
  const uint32_t seed = Hash(part.variant, 9, look.wall);
  // One in twelve has been replaced by another make.
  const bool odd = Draw(part, look, 11) < 0.08f;
  const Colour frame =
      (odd ? FromSrgb(228, 228, 226) : look.frame) * Tone(0.12f * (Draw(part, look, 12) - 0.5f));
  PaintGlass(tile, look, part, box);
  PaintFrame(tile, box, 0.065f, frame, seed);
  Divide(tile, look, Inset(box, 0.06f), frame, seed);
}

}  // namespace stucco::simulate::internal
