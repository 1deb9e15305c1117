// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>

#include "simulate/paint/internal/wall_look.h"

namespace stucco::simulate::internal {
namespace {

// Boards or sheets of a regular grid: which one, and how far inside it.
struct Sheet {
  int column = 0;
  int row = 0;
  float x = 0;  // from its left and top edges
  float y = 0;
  float inside = 0;
};

Sheet SheetAt(float x, float y, float width_m, float height_m) {
  Sheet sheet;
  sheet.column = Floor(x / width_m);
  sheet.row = Floor(y / height_m);
  sheet.x = x - static_cast<float>(sheet.column) * width_m;
  sheet.y = y - static_cast<float>(sheet.row) * height_m;
  sheet.inside =
      std::min(std::min(sheet.x, width_m - sheet.x), std::min(sheet.y, height_m - sheet.y));
  return sheet;
}

// How far sheets stray from the palette's mean: along its first two axes, and in tone.
struct Spread {
  float first = 0;
  float second = 0;
  float tone = 0;
};

Colour SheetColour(const WallLook& look, const Sheet& sheet, const Spread& spread) {
  const auto draw = [&](int k) { return Normal(sheet.column, sheet.row, look.wall + k); };
  return Pick(look.palette, spread.first * draw(1), spread.second * draw(2), draw(3)) *
         Tone(spread.tone * draw(4));
}

// Blowholes: at most one bubble in a square of 6 cm.
float Bubble(float x, float y, uint32_t seed, float texel_m) {
  constexpr float kCell_m = 0.06f;
  const int cx = Floor(x / kCell_m);
  const int cy = Floor(y / kCell_m);
  const uint32_t h = Hash(cx, cy, seed);
  if ((h & 3) != 0) return 0;
  const float radius = 0.002f + 0.008f * ToUnit(h * 0x85ebca77u) * ToUnit(h * 0xc2b2ae3du);
  const float dx = x - (static_cast<float>(cx) + 0.2f + 0.6f * ToUnit(h)) * kCell_m;
  const float dy = y - (static_cast<float>(cy) + 0.2f + 0.6f * ToUnit(h * 0x9e3779b1u)) * kCell_m;
  return Edge(radius - std::sqrt(dx * dx + dy * dy), texel_m) *
         std::min(1.0f, 2 * radius / texel_m);
}

// Holes of the ties that held the forms: at the quarters of a sheet.
float TieHole(const Sheet& sheet, float width_m, float height_m, float texel_m) {
  const float dx = std::abs(std::abs(sheet.x - width_m / 2) - width_m / 4);
  const float dy = std::abs(std::abs(sheet.y - height_m / 2) - height_m / 4);
  return Edge(0.016f - std::sqrt(dx * dx + dy * dy), texel_m);
}

}  // namespace

void PaintConcrete(Tile& tile, const WallLook& look) {
  const float texel = tile.texel_m;
  const float width = Trait(look, 1) < 0.5f ? 1.25f : 2.5f;
  const float height = Trait(look, 2) < 0.5f ? 1.25f : 2.7f;
  const bool ties = Trait(look, 3) < 0.7f;
  const Field cloud(tile, StepFor(0.2f, texel), [&](float x, float y) {
    return Noise(x, y, {0.9f, 3, 0.7f, look.wall + 5}, texel);
  });
  const float grain = 0.05f * std::min(1.0f, 0.01f / texel);
  for (int row = 0; row < tile.height; ++row) {
    const float y = tile.Y(row);
    int last = -1 << 30;
    Colour colour;
    for (int column = 0; column < tile.width; ++column) {
      const float x = tile.X(column);
      const Sheet sheet = SheetAt(x, y, width, height);
      if (sheet.column != last) {
        last = sheet.column;
        colour = SheetColour(look, sheet, {0.5f, 0.7f, 0.05f});
      }
      const float white = Normal(tile.x0 + column, tile.y0 + row, look.wall + 3);
      float tone = 0.045f * cloud(column, row) + grain * white +
                   0.03f * GradientNoise(x * 28, y * 28, look.wall + 8) * BandShare(0.035f, texel);
      tone -= 0.9f * Bubble(x, y, look.wall + 11, texel);
      if (ties) tone -= 1.2f * TieHole(sheet, width, height, texel);
      const float seam = Edge(0.004f - sheet.inside, texel);
      tone -= 0.55f * seam - 0.05f * Smooth(0.06f, 0.0f, sheet.inside);
      tile.At(column, row) = colour * Tone(tone);
    }
  }
}

void PaintPanels(Tile& tile, const WallLook& look) {
  const float texel = tile.texel_m;
  const bool ribbed = Trait(look, 1) < 0.3f;
  const float width = ribbed ? 1.0f : 0.9f + 0.9f * Trait(look, 2);
  const float height = ribbed ? 6.0f : 0.6f + 1.2f * Trait(look, 3);
  const float joint = ribbed ? 0.004f : 0.006f + 0.006f * Trait(look, 4);
  const float grain = 0.02f * std::min(1.0f, 0.01f / texel);
  constexpr float kRib_m = 0.2f;
  for (int row = 0; row < tile.height; ++row) {
    const float y = tile.Y(row);
    int last = -1 << 30;
    Colour colour;
    float tilt = 0;
    for (int column = 0; column < tile.width; ++column) {
      const float x = tile.X(column);
      const Sheet sheet = SheetAt(x, y, width, height);
      if (sheet.column != last) {
        last = sheet.column;
        colour = SheetColour(look, sheet, {0.3f, 0.4f, 0.04f});
        tilt = 0.05f * Normal(sheet.column, sheet.row, look.wall + 5);
      }
      const float white = Normal(tile.x0 + column, tile.y0 + row, look.wall + 3);
      float tone = grain * white + tilt * (sheet.y / height - 0.5f);
      if (ribbed) {
        const float in_rib = x - kRib_m * static_cast<float>(Floor(x / kRib_m));
        tone += 0.10f * Smooth(0.03f, 0.05f, in_rib) - 0.22f * Smooth(0.15f, 0.17f, in_rib) +
                0.12f * Smooth(0.18f, 0.2f, in_rib);
      }
      // Screws near the corners.
      const float dx = std::min(sheet.x, width - sheet.x) - 0.06f;
      const float dy = std::min(sheet.y, height - sheet.y) - 0.06f;
      tone -= 0.5f * Edge(0.007f - std::sqrt(dx * dx + dy * dy), texel);
      const Colour face = colour * Tone(tone);
      tile.At(column, row) = Mix(face, colour * 0.18f, Edge(joint - sheet.inside, texel));
    }
  }
}

}  // namespace stucco::simulate::internal
