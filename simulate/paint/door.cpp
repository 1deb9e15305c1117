// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>

#include "simulate/paint/internal/openings.h"

namespace stucco::simulate::internal {
namespace {

// A field of a door leaf: a sunk board with mouldings around it.
void PaintField(Tile& tile, const Box& box, Colour colour, uint32_t seed) {
  PaintBar(tile, box, colour * 0.62f, seed);
  PaintBar(tile, Inset(box, 0.03f), colour * 0.95f, seed + 1);
}

void PaintLeaf(Tile& tile, const WallLook& look, const WallPart& part, const Box& leaf) {
  const uint32_t seed = Hash(part.variant, 21, look.wall);
  const Colour colour = look.shutter * Tone(0.3f * (ToUnit(seed) - 0.5f));
  Fill(tile, leaf, [&](float x, float y, Colour) {
    const float grain = 0.07f * Noise(x * 5, y * 0.4f, {0.3f, 5, 0.7f, seed}, tile.texel_m);
    return colour * Tone(grain);
  });
  const float side = 0.14f * leaf.Width();
  const float mid = leaf.top + 0.55f * leaf.Height();
  const Box upper = {leaf.left + side, leaf.top + side, leaf.right - side, mid - side / 2};
  const Box lower = {leaf.left + side, mid + side / 2, leaf.right - side, leaf.bottom - 0.18f};
  if ((seed & 1) != 0 && upper.Height() > 0.2f) {
    PaintGlass(tile, look, part, upper);
    PaintFrame(tile, upper, 0.025f, colour * 0.7f, seed);
  } else {
    PaintField(tile, upper, colour, seed);
  }
  PaintField(tile, lower, colour, seed + 5);
  // Handle, letter slot, kick plate.
  const float handle_y = leaf.bottom - 1.0f;
  Fill(tile, {leaf.right - 0.09f, handle_y - 0.08f, leaf.right - 0.05f, handle_y + 0.08f},
       FromSrgb(186, 170, 120));
  Fill(tile, {leaf.left + side, mid - 0.03f, leaf.right - side, mid + 0.01f},
       FromSrgb(150, 140, 120));
  Fill(tile, {leaf.left, leaf.bottom - 0.12f, leaf.right, leaf.bottom}, colour * 0.5f);
}

}  // namespace

void PaintDoor(Tile& tile, const WallLook& look, const WallPart& part) {
  const Box box = BoxOf(part);
  const float light = box.Height() > 2.35f ? box.Height() - 2.15f : 0;  // the window above
  PaintFrame(tile, box, 0.08f, look.frame, look.wall + 91);
  const Box inner = {box.left + 0.08f, box.top + 0.08f, box.right - 0.08f, box.bottom};
  if (light > 0.1f) {
    const Box above = {inner.left, inner.top, inner.right, box.top + light};
    PaintGlass(tile, look, part, above);
    PaintFrame(tile, above, 0.03f, look.frame, look.wall + 93);
  }
  const Box leaf = {inner.left, box.top + std::max(light, 0.08f), inner.right, inner.bottom};
  if (box.Width() > 1.5f) {
    const float middle = (box.left + box.right) / 2;
    PaintLeaf(tile, look, part, {leaf.left, leaf.top, middle - 0.008f, leaf.bottom});
    PaintLeaf(tile, look, part, {middle + 0.008f, leaf.top, leaf.right, leaf.bottom});
  } else {
    PaintLeaf(tile, look, part, leaf);
  }
  Shade(tile, {box.left, box.top, box.right, box.top + 0.3f},
        [&](float, float y) { return 0.45f + 0.55f * Smooth(0, 0.3f, y - box.top); });
}

void PaintBalcony(Tile& tile, const WallLook& look, const WallPart& part) {
  const Box box = BoxOf(part);
  const uint32_t seed = Hash(look.building, 25);
  const float slab_m = std::min(static_cast<float>(kBalconySlab_m), box.Height());
  const Box slab = {box.left, box.bottom - slab_m, box.right, box.bottom};
  const Box rail = {box.left, box.top, box.right, slab.top};
  const float style = ToUnit(seed);
  const Colour metal = style < 0.3f ? Grey(0.04f) : style < 0.6f ? Grey(0.4f) : look.shutter;
  const bool solid = (seed & 1) != 0;
  Fill(tile, rail, [&](float x, float y, Colour) {
    if (solid) {
      const float sheet = x - 1.2f * static_cast<float>(Floor(x / 1.2f));
      const float gap = Edge(0.006f - std::min(sheet, 1.2f - sheet), tile.texel_m);
      return metal * ((1 - 0.7f * gap) *
                      Tone(0.05f * Noise(x, y, {1.0f, 7, 0.6f, look.wall + 95}, tile.texel_m)));
    }
    // Between the bars one sees the shaded wall behind, and what stands on the balcony.
    const float things = Noise(x, y, {0.5f, 4, 0.6f, part.variant * 31 + look.wall}, tile.texel_m);
    const Colour behind = Mix(look.surround * 0.16f, Colour{0.09f, 0.11f, 0.08f},
                              Smooth(0.4f, 0.6f, things - 1.2f * (rail.bottom - y)));
    constexpr float kPitch_m = 0.11f;
    const float bar = x - kPitch_m * static_cast<float>(Floor(x / kPitch_m));
    return Mix(behind * Tone(0.2f * things), metal, Cover(bar, 0.045f, 0.065f, tile.texel_m));
  });
  PaintBar(tile, {rail.left, rail.top, rail.right, std::min(rail.top + 0.05f, rail.bottom)}, metal,
           seed + 1);
  PaintBar(tile, slab, look.surround * 0.85f, seed + 2);
  Shade(tile, slab, [&](float x, float y) {
    const float drip = Noise(x, 0.1f * y, {0.2f, 4, 0.7f, look.wall + 97}, tile.texel_m);
    return 1 - 0.4f * Smooth(0, 2, drip);
  });
}

void PaintCornice(Tile& tile, const WallLook& look, const WallPart& part) {
  const Box box = BoxOf(part);
  const float height = box.Height();
  const bool dentils = Trait(look, 45) < 0.5f && height > 0.25f;
  constexpr float kPitch_m = 0.24f;
  Fill(tile, box, [&](float x, float y, Colour) {
    const float v = (y - box.top) / height;
    // Fillet, cyma and corona catch light and shade in turn.
    const float profile =
        0.10f * std::sin(v * 19) - 0.28f * Smooth(0.5f, 0.58f, v) + 0.2f * Smooth(0.72f, 0.78f, v);
    float tone = profile + 0.05f * Noise(x, y, {0.8f, 6, 0.65f, look.wall + 47}, tile.texel_m);
    if (dentils && v > 0.5f && v < 0.75f) {
      const float in = x - kPitch_m * static_cast<float>(Floor(x / kPitch_m));
      tone -= 0.7f * Cover(in, kPitch_m * 0.55f, kPitch_m, tile.texel_m);
    }
    const float joint = x - 1.1f * static_cast<float>(Floor(x / 1.1f));
    tone -= 0.25f * Edge(0.004f - std::min(joint, 1.1f - joint), tile.texel_m);
    return look.surround * Tone(tone);
  });
  Shade(tile, {box.left, box.bottom, box.right, box.bottom + 0.25f},
        [&](float, float y) { return 0.6f + 0.4f * Smooth(0, 0.25f, y - box.bottom); });
}

void PaintLedge(Tile& tile, const WallLook& look, const WallPart& part) {
  const Box box = BoxOf(part);
  constexpr float kSheet_m = 3;
  Fill(tile, box, [&](float x, float y, Colour) {
    const int sheet = Floor(x / kSheet_m);
    const float in = x - static_cast<float>(sheet) * kSheet_m;
    const float gap = Edge(0.005f - std::min(in, kSheet_m - in), tile.texel_m);
    const float wear = 0.04f * Noise(x, 0.3f * y, {0.6f, 5, 0.7f, look.wall + 57}, tile.texel_m);
    const float lit =
        0.12f * Smooth(0.02f, 0, y - box.top) - 0.2f * Smooth(0.03f, 0, box.bottom - y);
    return look.surround *
           (Tone(0.04f * Normal(sheet, 2, look.wall) + wear + lit) * (1 - 0.6f * gap));
  });
}

void PaintPlinth(Tile& tile, const WallLook& look, const WallPart& part) {
  const Box box = BoxOf(part);
  const Colour colour = look.surround * (0.35f + 0.3f * Trait(look, 46));
  const float length = 0.7f + 0.6f * Trait(look, 47);
  Fill(tile, box, [&](float x, float y, Colour) {
    const int block = Floor(x / length);
    const float in = x - static_cast<float>(block) * length;
    const float joint = Edge(0.006f - std::min(in, length - in), tile.texel_m);
    const float tone = 0.10f * Normal(block, 1, look.wall + 49) +
                       0.06f * Noise(x, y, {0.5f, 6, 0.75f, look.wall + 51}, tile.texel_m) +
                       0.05f * Normal(Floor(x / tile.texel_m), Floor(y / tile.texel_m), look.wall);
    const float splash = 0.35f * Smooth(0.4f, 0, box.bottom - y);
    return colour * (Tone(tone - splash) * (1 - 0.5f * joint));
  });
  PaintBar(tile, {box.left, box.top, box.right, std::min(box.top + 0.06f, box.bottom)},
           colour * 1.2f, look.wall + 53);
}

}  // namespace stucco::simulate::internal
