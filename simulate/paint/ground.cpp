// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>

#include "simulate/paint/internal/covering_look.h"
#include "simulate/paint/internal/cracks.h"

namespace stucco::simulate::internal {
namespace {

// Where the ground was opened and closed again: at most one patch in a square of 5 m.
struct Cut {
  float inside = -1;  // signed distance from its edge
  float tone = 0;
  float tar_m = 0;  // half the width of the sealed joint
};

Cut CutAt(float x, float y, uint32_t seed) {
  constexpr float kCell_m = 5;
  const int cx = Floor(x / kCell_m);
  const int cy = Floor(y / kCell_m);
  const uint32_t h = Hash(cx, cy, seed);
  if (h % 3 != 0) return {};
  const float left = kCell_m * (static_cast<float>(cx) + 0.4f * ToUnit(h * 0x9e3779b1u));
  const float top = kCell_m * (static_cast<float>(cy) + 0.4f * ToUnit(h * 0x85ebca77u));
  const float wide = 0.6f + 2.2f * ToUnit(h * 0xc2b2ae3du);
  const float high = 0.6f + 2.2f * ToUnit(h * 0x2c1b3c6du);
  const float inside =
      std::min(std::min(x - left, left + wide - x), std::min(y - top, top + high - y));
  const float ragged =
      std::abs(inside) < 0.2f ? 0.03f * Noise(x, y, {0.7f, 3, 0.6f, h}, 0.02f) : 0.0f;
  return {inside + ragged, 0.5f * (ToUnit(h) - 0.6f), (h & 0x300) != 0 ? 0.015f : 0.0f};
}

// Spots of gum, drips and leaves: the share of a texel that one covers.
float Gum(float x, float y, uint32_t seed, float texel_m) {
  constexpr float kCell_m = 0.16f;
  const int cx = Floor(x / kCell_m);
  const int cy = Floor(y / kCell_m);
  const uint32_t h = Hash(cx, cy, seed);
  if (h % 23 != 0) return 0;
  const float dx = x / kCell_m - static_cast<float>(cx) - 0.25f - 0.5f * ToUnit(h * 0x9e3779b1u);
  const float dy = y / kCell_m - static_cast<float>(cy) - 0.25f - 0.5f * ToUnit(h * 0x85ebca77u);
  const float radius_m = 0.008f + 0.02f * ToUnit(h * 0xc2b2ae3du);
  return Edge(radius_m - kCell_m * std::sqrt(dx * dx + dy * dy), texel_m);
}

// A cast-iron lid: at most one in a square of 9 m. Negative outside.
float Lid(float x, float y, uint32_t seed, float& pattern) {
  constexpr float kCell_m = 9;
  const int cx = Floor(x / kCell_m);
  const int cy = Floor(y / kCell_m);
  const uint32_t h = Hash(cx, cy, seed);
  if ((h & 1) != 0) return -1;
  const float dx = x - kCell_m * (static_cast<float>(cx) + 0.1f + 0.8f * ToUnit(h * 0x9e3779b1u));
  const float dy = y - kCell_m * (static_cast<float>(cy) + 0.1f + 0.8f * ToUnit(h * 0x85ebca77u));
  pattern = std::sin(dx * 90) * std::sin(dy * 90);
  return 0.32f - std::sqrt(dx * dx + dy * dy);
}

}  // namespace

void PaintAsphalt(Tile& tile, const CoveringLook& look) {
  const float texel = tile.texel_m;
  const Colour base = Mix(FromSrgb(84, 84, 86), FromSrgb(128, 126, 122), Trait(look, 1));
  const Field stain(tile, StepFor(0.25f, texel), [&](float x, float y) {
    return Noise(x, y, {6.0f, 5, 0.6f, look.seed + 5}, texel);
  });
  const Field worn(tile, StepFor(0.6f, texel), [&](float x, float y) {
    return Noise(x, y, {8.0f, 3, 0.6f, look.seed + 6}, texel);
  });
  const Field bend(tile, StepFor(0.3f, texel), [&](float x, float y) {
    return Noise(x, y, {1.7f, 3, 0.6f, look.seed + 8}, texel);
  });
  const Cracks cracks = {0.7f, 0.22f, {0.21f, 2, 0.6f, look.seed + 9}, 0.006f, texel};
  for (int row = 0; row < tile.height; ++row) {
    const float y = tile.Y(row);
    for (int column = 0; column < tile.width; ++column) {
      const float x = tile.X(column);
      const float g = Grain(tile, column, row, look.seed + 3);
      // Light chippings show here and there.
      const float chip = g > 1.6f ? 0.25f : 0.0f;
      float tone = 0.13f * g + chip + 0.11f * stain(column, row);
      const float crumb = GradientNoise(x * 18, y * 18, look.seed + 4) * BandShare(0.055f, texel);
      tone += 0.05f * crumb - 0.25f * Smooth(2.0f, 2.5f, crumb);
      const Cut cut = CutAt(x, y, look.seed + 7);
      tone += cut.tone * Edge(cut.inside, texel);
      const float open = Smooth(-0.2f, 1.0f, worn(column, row));
      tone -= 0.8f * CrackShare(cracks, x, y, bend(column, row), open);
      Colour colour = base * Tone(tone);
      // Joints of patches are sealed with tar.
      colour = Mix(colour, Grey(0.012f), 0.7f * Edge(cut.tar_m - std::abs(cut.inside), texel));
      const float oil = GradientNoise(x * 0.9f, y * 0.9f, look.seed + 10);
      colour = colour * (1 - 0.28f * Smooth(1.9f, 3.0f, oil));
      colour = colour * (1 + 0.5f * Gum(x, y, look.seed + 11, texel));
      float pattern = 0;
      const float lid = Lid(x, y, look.seed + 12, pattern);
      colour = Mix(colour, Grey(0.055f) * Tone(0.6f * pattern + 0.1f * g), Edge(lid, texel));
      colour = colour * (1 - 0.6f * Edge(0.012f - std::abs(lid), texel));
      tile.At(column, row) = colour;
    }
  }
}

void PaintPaving(Tile& tile, const CoveringLook& look) {
  const float texel = tile.texel_m;
  const float kind = Trait(look, 1);
  const float stone_x = kind < 0.4f ? 0.30f : kind < 0.7f ? 0.20f : 0.11f;
  const float stone_y = kind < 0.4f ? 0.30f : kind < 0.7f ? 0.10f : 0.11f;
  const Colour base = kind < 0.4f   ? FromSrgb(158, 154, 146)
                      : kind < 0.7f ? FromSrgb(140, 112, 100)
                                    : FromSrgb(128, 124, 118);
  const float spread = kind < 0.4f ? 0.06f : 0.13f;
  const Field stain(tile, StepFor(0.25f, texel), [&](float x, float y) {
    return Noise(x, y, {4.0f, 5, 0.6f, look.seed + 5}, texel);
  });
  for (int row = 0; row < tile.height; ++row) {
    const float y = tile.Y(row);
    for (int column = 0; column < tile.width; ++column) {
      const float x = tile.X(column);
      const int course = Floor(y / stone_y);
      const float shifted = x + ((course & 1) != 0 ? stone_x / 2 : 0.0f);
      const int rank = Floor(shifted / stone_x);
      const float u = shifted - static_cast<float>(rank) * stone_x;
      const float v = y - static_cast<float>(course) * stone_y;
      const float g = Grain(tile, column, row, look.seed + 3);
      const float wobble = 0.0025f * GradientNoise(x * 25, y * 25, look.seed + 4);
      const float inside =
          std::min(std::min(u, stone_x - u), std::min(v, stone_y - v)) - 0.005f + wobble;
      const float tone =
          spread * Normal(rank, course, look.seed + 1) + 0.07f * g + 0.08f * stain(column, row);
      const float hue = 0.06f * Normal(rank, course, look.seed + 2);
      const Colour stone = base * Colour{1 + hue, 1, 1 - hue} * Tone(tone);
      const float green = Smooth(0.4f, 1.6f, stain(column, row));
      const Colour joint = Mix(base * 0.42f, Colour{0.08f, 0.11f, 0.05f}, green) * Tone(0.3f * g);
      Colour colour = Mix(joint, stone, Edge(inside, texel));
      colour = colour * (1 - 0.4f * Gum(x, y, look.seed + 8, texel));
      float pattern = 0;
      const float lid = Lid(x, y, look.seed + 12, pattern);
      colour = Mix(colour, Grey(0.06f) * Tone(0.6f * pattern + 0.1f * g), Edge(lid, texel));
      tile.At(column, row) = colour;
    }
  }
}

// Daisies and dandelions: at most one in a square of 20 cm, where they grow at all. The share of a
// texel that one covers.
float Flower(float x, float y, uint32_t seed, float texel_m) {
  constexpr float kCell_m = 0.2f;
  const int cx = Floor(x / kCell_m);
  const int cy = Floor(y / kCell_m);
  const uint32_t h = Hash(cx, cy, seed);
  if (h % 5 != 0) return 0;
  const float dx = x / kCell_m - static_cast<float>(cx) - 0.2f - 0.6f * ToUnit(h * 0x9e3779b1u);
  const float dy = y / kCell_m - static_cast<float>(cy) - 0.2f - 0.6f * ToUnit(h * 0x85ebca77u);
  constexpr float kRadius_m = 0.012f;
  const float whole = std::min(1.0f, 4 * kRadius_m * kRadius_m / (texel_m * texel_m));
  return whole * Edge(std::max(kRadius_m, texel_m / 2) - kCell_m * std::hypot(dx, dy), texel_m);
}

// Blades, tufts, and how it grows from place to place, in one spectrum from a blade to a metre: a
// lawn has no size of its own. Turned, as lattices of noise run along x and y and grass does not.
float Sward(float x, float y, uint32_t seed, float texel_m) {
  const float u = 0.8f * x + 0.6f * y;
  const float v = 0.8f * y - 0.6f * x;
  return Noise(u, v, {0.9f, 6, 0.82f, seed}, texel_m);
}

void PaintGrass(Tile& tile, const CoveringLook& look) {
  const float texel = tile.texel_m;
  const Colour lush = Mix(FromSrgb(74, 88, 52), FromSrgb(98, 106, 66), Trait(look, 1));
  const Colour dry = FromSrgb(136, 128, 92);
  const Colour clover = FromSrgb(62, 84, 52);
  const Field meadow(tile, StepFor(0.5f, texel), [&](float x, float y) {
    return Noise(0.9f * x + 0.4f * y, 0.9f * y - 0.4f * x, {7.0f, 4, 0.6f, look.seed + 5}, texel);
  });
  const Field herbs(tile, StepFor(0.3f, texel), [&](float x, float y) {
    return Noise(0.6f * x - 0.8f * y, 0.6f * y + 0.8f * x, {2.3f, 4, 0.6f, look.seed + 6}, texel);
  });
  for (int row = 0; row < tile.height; ++row) {
    const float y = tile.Y(row);
    for (int column = 0; column < tile.width; ++column) {
      const float x = tile.X(column);
      const float m = meadow(column, row);
      const float h = herbs(column, row);
      const float sward = Sward(x, y, look.seed + 2, texel);
      const float blade = Grain(tile, column, row, look.seed + 3);
      const float parched = Smooth(-1.0f, 3.4f, m + 0.3f * sward + 0.12f * blade);
      Colour colour = Mix(lush, dry, 0.8f * parched);
      colour = Mix(colour, clover, 0.6f * Smooth(0.7f, 1.5f, h + 0.2f * sward));
      colour = colour * Tone(0.11f * sward + 0.34f * blade - 0.08f * m);
      const float bare = Smooth(2.5f, 3.3f, -m - 0.6f * h + 0.4f * sward);
      colour = Mix(colour, FromSrgb(112, 100, 78) * Tone(0.08f * sward + 0.15f * blade), bare);
      const float grows = Smooth(0.6f, 1.2f, -h);
      if (grows > 0) {
        colour = Mix(colour, Grey(0.6f), grows * Flower(x, y, look.seed + 9, texel));
      }
      tile.At(column, row) = colour;
    }
  }
}

// A field of grain, from green to ripe, in rows, with the tracks of the tractor.
void PaintCrop(Tile& tile, const CoveringLook& look) {
  const float texel = tile.texel_m;
  const Colour base = Mix(FromSrgb(82, 102, 56), FromSrgb(160, 148, 110), Trait(look, 1));
  const Colour soil = FromSrgb(118, 100, 78);
  constexpr float kRow_m = 0.125f;
  constexpr float kTracks_m = 12;
  constexpr float kGauge_m = 1.8f;
  const Field growth(tile, StepFor(0.3f, texel), [&](float x, float y) {
    return Noise(0.8f * x + 0.6f * y, 0.8f * y - 0.6f * x, {9.0f, 5, 0.6f, look.seed + 5}, texel);
  });
  for (int row = 0; row < tile.height; ++row) {
    const float y = tile.Y(row);
    for (int column = 0; column < tile.width; ++column) {
      const float x = tile.X(column);
      const float g = growth(column, row);
      const float sward = Sward(x, y, look.seed + 2, texel);
      const float blade = Grain(tile, column, row, look.seed + 3);
      const float rows = std::cos(6.2832f * x / kRow_m) * BandShare(kRow_m, texel);
      Colour colour = base * Tone(0.07f * sward + 0.2f * blade + 0.1f * rows + 0.07f * g);
      const float across = x - kTracks_m * (static_cast<float>(Floor(x / kTracks_m)) + 0.5f);
      const float track = Edge(0.17f - std::abs(std::abs(across) - kGauge_m / 2), texel);
      const float thin = std::max(0.7f * track, Smooth(2.0f, 3.2f, -g + 0.3f * sward));
      colour = Mix(colour, soil * Tone(0.06f * sward + 0.12f * blade), thin);
      tile.At(column, row) = colour;
    }
  }
}

void PaintSoil(Tile& tile, const CoveringLook& look) {
  const float texel = tile.texel_m;
  const Colour base = Mix(FromSrgb(112, 92, 70), FromSrgb(140, 122, 98), Trait(look, 1));
  const Field lie(tile, StepFor(0.15f, texel), [&](float x, float y) {
    return Noise(x, y, {3.0f, 5, 0.65f, look.seed + 5}, texel);
  });
  for (int row = 0; row < tile.height; ++row) {
    const float y = tile.Y(row);
    for (int column = 0; column < tile.width; ++column) {
      const float x = tile.X(column);
      const float clod = GradientNoise(x * 13, y * 13, look.seed + 2) * BandShare(0.077f, texel);
      const float g = Grain(tile, column, row, look.seed + 3);
      const float stone = GradientNoise(x * 22, y * 22, look.seed + 4) * BandShare(0.045f, texel);
      Colour colour = base * Tone(0.14f * clod + 0.13f * g + 0.15f * lie(column, row));
      colour = Mix(colour, Grey(0.3f) * Tone(0.1f * g), Smooth(1.9f, 2.2f, stone));
      const float weed = lie(column, row) + 0.5f * clod;
      colour = Mix(colour, Colour{0.08f, 0.12f, 0.04f} * Tone(0.3f * g),
                   0.7f * Smooth(1.5f, 2.1f, weed));
      tile.At(column, row) = colour;
    }
  }
}

}  // namespace stucco::simulate::internal
