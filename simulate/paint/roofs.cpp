// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>
#include <cmath>

#include "simulate/paint/internal/covering_look.h"

namespace stucco::simulate::internal {
namespace {

Colour TileColour(int palette) {
  constexpr std::array<std::array<uint8_t, 3>, 6> kColours = {
      {{142, 92, 72}, {122, 76, 62}, {96, 70, 62}, {86, 86, 88}, {150, 106, 84}, {72, 74, 78}}};
  const int count = static_cast<int>(kColours.size());
  const auto& c = kColours[((palette % count) + count) % count];
  return FromSrgb(c[0], c[1], c[2]);
}

}  // namespace

void PaintTiles(Tile& tile, const CoveringLook& look) {
  const float texel = tile.texel_m;
  const Colour base = TileColour(look.design->palette);
  const float pitch_x = 0.20f + 0.05f * Trait(look, 1);
  const float pitch_y = 0.30f + 0.06f * Trait(look, 2);
  const bool broken = Trait(look, 3) < 0.5f;  // joints of every other row shifted
  const float spread = 0.08f + 0.12f * Trait(look, 4);
  const Field moss(tile, StepFor(0.15f, texel), [&](float x, float y) {
    return Noise(x, y, {1.6f, 4, 0.6f, look.seed + 5}, texel);
  });
  const float mossy = 0.2f + 1.3f * Trait(look, 5);
  for (int row = 0; row < tile.height; ++row) {
    const float y = tile.Y(row);
    for (int column = 0; column < tile.width; ++column) {
      const float x = tile.X(column);
      const int course = Floor(y / pitch_y);
      const float shifted = x + (broken && (course & 1) != 0 ? pitch_x / 2 : 0.0f);
      const int rank = Floor(shifted / pitch_x);
      const float u = shifted / pitch_x - static_cast<float>(rank);
      // Tiles hang a little unevenly: each lower edge at its own height.
      const float hang = 0.006f * Normal(rank, course, look.seed + 9);
      const float v = (y - static_cast<float>(course) * pitch_y + hang) / pitch_y;
      const float tone = spread * Normal(rank, course, look.seed + 1);
      const float odd = Uniform(rank, course, look.seed + 2) > 0.985f ? 0.35f : 0.0f;
      // A pantile's roll, and the shade that a course throws on the next.
      const float roll = 0.16f * std::cos(6.2832f * (u - 0.3f));
      const float grain =
          0.06f * Grain(tile, column, row, look.seed + 3) +
          0.05f * GradientNoise(x * 24, y * 24, look.seed + 4) * BandShare(0.04f, texel);
      Colour colour =
          base * Colour{1 + 0.3f * tone, 1, 1 - 0.2f * tone} * Tone(tone + odd + roll + grain);
      colour = colour * (1 - 0.55f * Smooth(0.10f, 0.0f, v)) * (1 + 0.12f * Smooth(0.9f, 1.0f, v));
      const float joint = std::min(u, 1 - u) * pitch_x;
      colour = colour * (1 - 0.5f * Edge(0.005f - joint, texel));
      const float growth = moss(column, row) + 0.6f * GradientNoise(x * 11, y * 11, look.seed + 6) +
                           mossy - 2.6f + 0.5f * Smooth(0.2f, 0.0f, v);
      colour = Mix(colour, Colour{0.10f, 0.11f, 0.045f} * Tone(4 * grain),
                   0.65f * Smooth(0.0f, 1.1f, growth));
      const float lichen = GradientNoise(x * 17, y * 17, look.seed + 7);
      colour = Mix(colour, Grey(0.35f), 0.5f * Smooth(2.2f, 2.6f, lichen + 0.25f * mossy));
      tile.At(column, row) = colour;
    }
  }
}

void PaintMembrane(Tile& tile, const CoveringLook& look) {
  const float texel = tile.texel_m;
  const FacadePicture& picture = PictureOf("membrane", look.design->palette);
  const Colour base =
      Pick(picture.palette, 0, Trait(look, 1) - 0.5f, 0) * (0.6f + 0.6f * Trait(look, 2));
  constexpr float kSheet_m = 1.02f;
  const Field stain(tile, StepFor(0.2f, texel), [&](float x, float y) {
    return Noise(x, y, {2.7f, 5, 0.6f, look.seed + 5}, texel);
  });
  for (int row = 0; row < tile.height; ++row) {
    const float y = tile.Y(row);
    for (int column = 0; column < tile.width; ++column) {
      const float x = tile.X(column);
      const int sheet = Floor(x / kSheet_m);
      const float in = x - static_cast<float>(sheet) * kSheet_m;
      const float start = 7.5f * Uniform(sheet, 1, look.seed);
      const int length = Floor((y + start) / 7.5f);
      const float along = y + start - 7.5f * static_cast<float>(length);
      float tone = 0.05f * Normal(sheet, length, look.seed + 1) + 0.09f * stain(column, row) +
                   0.06f * Grain(tile, column, row, look.seed + 3);
      tone -= 0.35f * Edge(0.006f - in, texel) + 0.35f * Edge(0.006f - along, texel);
      tone -= 0.10f * Edge(0.09f - in, texel);  // the welded lap
      // Puddles leave rings.
      const float pond =
          GradientNoise(x * 0.45f, y * 0.45f, look.seed + 8) + 0.25f * stain(column, row);
      tone -= 0.14f * Smooth(0.8f, 1.2f, pond) + 0.08f * Edge(0.06f - std::abs(pond - 1.0f), 0.1f);
      // Leaves, moss and what birds drop.
      const float litter = GradientNoise(x * 14, y * 14, look.seed + 9);
      tone -= 0.5f * Smooth(1.9f, 2.3f, litter + 0.25f * stain(column, row));
      tone += 0.4f * Smooth(2.1f, 2.4f, -litter);
      Colour colour = base * Tone(tone);
      const int px = Floor(x / 4);
      const int py = Floor(y / 4);
      const uint32_t h = Hash(px, py, look.seed + 11);
      if (h % 5 == 0) {  // a patch of newer sheet
        const float left = 4 * (static_cast<float>(px) + 0.4f * ToUnit(h * 0x9e3779b1u));
        const float top = 4 * (static_cast<float>(py) + 0.4f * ToUnit(h * 0x85ebca77u));
        const float wide = 0.5f + 1.6f * ToUnit(h * 0xc2b2ae3du);
        const float inside =
            std::min(std::min(x - left, left + wide - x), std::min(y - top, top + 0.6f * wide - y));
        colour = Mix(colour,
                     base * (0.55f + 0.9f * ToUnit(h)) *
                         Tone(0.06f * Grain(tile, column, row, look.seed + 4)),
                     0.9f * Edge(inside, texel));
        colour = colour * (1 - 0.5f * Edge(0.03f - std::abs(inside), texel));
      }
      tile.At(column, row) = colour;
    }
  }
}

void PaintGravel(Tile& tile, const CoveringLook& look) {
  const float texel = tile.texel_m;
  const FacadePicture& picture = PictureOf("gravel", look.design->palette);
  const Colour base = Pick(picture.palette, 0, 0, 0) * (1.1f + 0.6f * Trait(look, 1));
  const Field stain(tile, StepFor(0.2f, texel), [&](float x, float y) {
    return Noise(x, y, {3.5f, 5, 0.6f, look.seed + 5}, texel);
  });
  for (int row = 0; row < tile.height; ++row) {
    const float y = tile.Y(row);
    for (int column = 0; column < tile.width; ++column) {
      const float x = tile.X(column);
      // Pebbles of 1 to 4 cm: two octaves with sharp gaps.
      const float pebble =
          0.6f * GradientNoise(x * 27, y * 27, look.seed + 2) * BandShare(0.037f, texel) +
          Grain(tile, column, row, look.seed + 3);
      const float hue = GradientNoise(x * 40, y * 40, look.seed + 4) * BandShare(0.025f, texel);
      const float tone = 0.24f * pebble + 0.14f * stain(column, row);
      Colour colour = base * Colour{1 + 0.06f * hue, 1, 1 - 0.06f * hue} * Tone(tone);
      const float moss = stain(column, row) + 0.4f * pebble;
      colour = Mix(colour, Colour{0.07f, 0.085f, 0.03f}, 0.6f * Smooth(1.3f, 2.2f, moss));
      tile.At(column, row) = colour;
    }
  }
}

void PaintMetal(Tile& tile, const CoveringLook& look) {
  const float texel = tile.texel_m;
  const FacadePicture& picture = PictureOf("metal", look.design->palette);
  Colour base = Pick(picture.palette, 0, 0, 0) * (0.5f + 0.6f * Trait(look, 1));
  if (Trait(look, 2) < 0.25f) base = FromSrgb(104, 150, 128) * 0.9f;  // copper
  const float pitch = 0.43f + 0.17f * Trait(look, 3);
  const Field stain(tile, StepFor(0.15f, texel), [&](float x, float y) {
    return Noise(x, 0.35f * y, {1.2f, 4, 0.6f, look.seed + 5}, texel);
  });
  for (int row = 0; row < tile.height; ++row) {
    const float y = tile.Y(row);
    for (int column = 0; column < tile.width; ++column) {
      const float x = tile.X(column);
      const int tray = Floor(x / pitch);
      const float in = x - static_cast<float>(tray) * pitch;
      const float cross = y + 3 * Uniform(tray, 1, look.seed);
      const float along = cross - 3 * static_cast<float>(Floor(cross / 3));
      float tone = 0.05f * Normal(tray, Floor(cross / 3), look.seed + 1) +
                   0.08f * stain(column, row) + 0.025f * Grain(tile, column, row, look.seed + 3) +
                   0.04f * GradientNoise(x * 6, y * 2, look.seed + 6);
      tone += 0.35f * Cover(in, 0, 0.012f, texel) - 0.9f * Cover(in, 0.012f, 0.035f, texel);
      tone -= 0.35f * Edge(0.006f - along, texel);
      // Clips on the seams, leaves caught by them, and rust or verdigris running from the joints.
      const float clip = cross - 0.5f * static_cast<float>(Floor(cross / 0.5f));
      tone -= 0.6f * Cover(clip, 0, 0.04f, texel) * Cover(in, 0.03f, 0.06f, texel);
      const float litter = GradientNoise(x * 16, y * 13, look.seed + 9);
      tone -= 0.4f * Smooth(2.0f, 2.4f, litter + 0.4f * Smooth(0.12f, 0.03f, in));
      const float run = GradientNoise(x * 19, y * 0.8f, look.seed + 10);
      const float rust = Smooth(0.4f, 1.8f, run) * Smooth(0.9f, 0.0f, along);
      tile.At(column, row) = base * Tone(tone) * Mix(Grey(1), {0.72f, 0.6f, 0.5f}, 0.6f * rust);
    }
  }
}

}  // namespace stucco::simulate::internal
