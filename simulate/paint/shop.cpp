// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>
#include <cmath>
#include <cstdlib>
#include <string_view>

#include "simulate/paint/internal/openings.h"

namespace stucco::simulate::internal {
namespace {

// Strokes of capital letters between points of a 3 x 5 grid, which are named a b c / d e f / ... /
// m n o from the top left; two names are one stroke.
constexpr std::array<std::string_view, 18> kLetters = {
    "mddbbffoghhi",  // A
    "amacghmo",      // E
    "amacgh",        // F
    "caammooiih",    // G
    "amcogi",        // H
    "bn",            // I
    "amcggo",        // K
    "ammo",          // L
    "ameaceco",      // M
    "amaoco",        // N
    "bddjjnnllffb",  // O
    "amacciig",      // P
    "amacciigho",    // R
    "caaggiioom",    // S
    "acbn",          // T
    "ajjnnllc",      // U
    "ancn",          // V
    "accmmo",        // Z
};

// Distance of (x, y), in grid steps, from a letter's strokes.
float Distance(std::string_view strokes, float x, float y) {
  float nearest = 100;
  for (size_t i = 0; i + 1 < strokes.size(); i += 2) {
    const int p = strokes[i] - 'a';
    const int q = strokes[i + 1] - 'a';
    const std::div_t from = std::div(p, 3);
    const std::div_t to = std::div(q, 3);
    const auto px = static_cast<float>(from.rem);
    const auto py = static_cast<float>(from.quot);
    const float dx = static_cast<float>(to.rem) - px;
    const float dy = static_cast<float>(to.quot) - py;
    const float along =
        std::clamp(((x - px) * dx + (y - py) * dy) / (dx * dx + dy * dy), 0.0f, 1.0f);
    const float ex = x - px - along * dx;
    const float ey = y - py - along * dy;
    nearest = std::min(nearest, ex * ex + ey * ey);
  }
  return std::sqrt(nearest);
}

Colour SignColour(uint32_t h) {
  constexpr std::array<std::array<uint8_t, 3>, 8> kColours = {{{150, 34, 36},
                                                               {26, 58, 104},
                                                               {30, 82, 52},
                                                               {208, 166, 40},
                                                               {36, 34, 36},
                                                               {222, 220, 214},
                                                               {190, 92, 30},
                                                               {94, 40, 84}}};
  const auto& c = kColours[h % kColours.size()];
  return FromSrgb(c[0], c[1], c[2]);
}

void PaintSign(Tile& tile, const Box& box, uint32_t seed) {
  const Colour ground = SignColour(seed);
  const Colour ink = Luminance(ground) > 0.3f ? Grey(0.03f) : Grey(0.75f);
  Fill(tile, box, [&](float x, float y, Colour) {
    return ground * Tone(0.06f * Noise(x, y, {1.2f, 6, 0.6f, seed}, tile.texel_m));
  });
  PaintFrame(tile, box, 0.03f, ground * 0.6f, seed);
  const float margin = 0.22f * box.Height();
  const float room = box.Width() - 2 * margin;
  const float words = std::min(room, box.Height() * (3 + 4 * ToUnit(seed * 0x9e3779b1u)));
  const float left = box.left + margin + (room - words) * 0.5f;
  PaintLetters(tile, {left, box.top + margin, left + words, box.bottom - margin}, ink, seed);
}

// Goods: heaps of coloured things on shelves, from a picture of a shop in the large.
void PaintGoods(Tile& tile, const Box& glass, uint32_t seed) {
  const std::vector<Pane>& shops = Facades().shops;
  const Pane& shop = shops[seed % shops.size()];
  constexpr float kThing_m = 0.11f;
  Fill(tile, glass, [&](float x, float y, Colour) {
    const float u = (x - glass.left) / glass.Width();
    const float v = (y - glass.top) / glass.Height();
    Colour seen = At(shop, u, v) * 0.9f;
    const int cx = Floor(x / kThing_m);
    const int cy = Floor(y / (2.2f * kThing_m));
    const uint32_t h = Hash(cx, cy, seed);
    const float in_x = x / kThing_m - static_cast<float>(cx) - 0.5f;
    const float in_y = y / (2.2f * kThing_m) - static_cast<float>(cy);
    const float tall = 0.25f + 0.6f * ToUnit(h * 0x85ebca77u);
    const float wide = 0.25f + 0.22f * ToUnit(h * 0xc2b2ae3du);
    const bool there = in_y > 1 - tall && std::abs(in_x) < wide && v > 0.3f && (h & 3) != 0;
    if (there)
      seen = Mix(seen, SignColour(h >> 8) * (0.65f + 0.3f * in_y - 1.8f * in_x * in_x), 0.75f);
    return seen * Tone(0.15f * Noise(x, y, {0.4f, 5, 0.6f, seed}, tile.texel_m));
  });
}

}  // namespace

void PaintLetters(Tile& tile, const Box& box, Colour colour, uint32_t seed) {
  const float step = box.Height() / 4;  // of the grid
  const float advance = 3.1f * step;
  if (!(step > 0)) return;
  constexpr float kStroke = 0.36f;
  Fill(tile, {box.left - step, box.top - step, box.right, box.bottom + step},
       [&](float x, float y, Colour under) {
         const int index = Floor((x - box.left + 0.5f * step) / advance);
         const uint32_t h = Hash(index, 4, seed);
         const float in_x = (x - box.left) / step - 3.1f * static_cast<float>(index);
         const bool fits = box.left + static_cast<float>(index + 1) * advance <= box.right + step;
         if (h % 7 == 0 || index < 0 || !fits) return under;
         const float distance =
             Distance(kLetters[(h >> 4) % kLetters.size()], in_x, (y - box.top) / step);
         return Mix(under, colour, Edge((kStroke - distance) * step, tile.texel_m));
       });
}

void PaintShopWindow(Tile& tile, const WallLook& look, const WallPart& part) {
  const Box box = BoxOf(part);
  const uint32_t seed = Hash(part.variant, 27, look.wall);
  const float sign_m = std::clamp(0.2f * box.Height(), 0.0f, 0.7f);
  const Box sign = {box.left, box.top, box.right, box.top + sign_m};
  const Box glass = {box.left, sign.bottom, box.right, box.bottom - 0.35f};
  PaintBar(tile, box, SignColour(seed >> 3) * 0.5f, seed);
  if (glass.Height() > 0.3f) {
    PaintGoods(tile, glass, seed);
    const Colour metal = (seed & 1) != 0 ? Grey(0.35f) : Grey(0.03f);
    Fill(tile, glass, [&](float x, float y, Colour under) {
      return Mix(under, Mirrored(x, y, glass.top + 1.2f, seed), 0.22f);
    });
    PaintFrame(tile, glass, 0.05f, metal, seed);
    for (float x = glass.left + 1.6f; x < glass.right - 0.8f; x += 1.6f) {
      PaintBar(tile, {x - 0.025f, glass.top, x + 0.025f, glass.bottom}, metal, seed + 1);
    }
    if ((seed & 12) != 0) {
      const float top = glass.top + 0.45f * glass.Height();
      PaintLetters(tile,
                   {glass.left + 0.3f, top, glass.left + 0.3f + 0.6f * glass.Width(), top + 0.16f},
                   Grey(0.7f), seed + 2);
    }
  }
  if (sign_m > 0.15f) PaintSign(tile, sign, seed);
}

}  // namespace stucco::simulate::internal
