// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>

#include "simulate/paint/internal/openings.h"

namespace stucco::simulate::internal {
namespace {

constexpr float kCourse_m = 0.075f;  // 65 mm of brick and 10 mm of mortar
constexpr float kStretcher_m = 0.25f;
constexpr float kHeader_m = 0.125f;

enum class Bond { kStretcher, kFlemish, kEnglish };

struct Brick {
  int row = 0;
  int column = 0;
  float left = 0;  // of its cell, half a joint of mortar included
  float right = 0;
};

Brick BrickAt(Bond bond, float x, int row) {
  const bool odd = (row & 1) != 0;
  if (bond == Bond::kFlemish) {
    const float period = kStretcher_m + kHeader_m;
    const float shifted = x + (odd ? period / 2 : 0) + 100 * period;
    const int pair = Floor(shifted / period);
    const float left = static_cast<float>(pair) * period;
    const bool header = shifted - left > kStretcher_m;
    const float start = x - shifted + left;
    return header ? Brick{row, 2 * pair + 1, start + kStretcher_m, start + period}
                  : Brick{row, 2 * pair, start, start + kStretcher_m};
  }
  const float length = bond == Bond::kEnglish && odd ? kHeader_m : kStretcher_m;
  const float shift = odd ? (bond == Bond::kEnglish ? kHeader_m / 2 : kStretcher_m / 2) : 0;
  const int column = Floor((x + shift) / length);
  const float left = static_cast<float>(column) * length - shift;
  return {row, column, left, left + length};
}

// One brick's colour: drawn along the axes of the picture's palette, some burnt too long, and a
// few replaced by ones of another kiln.
Colour BrickColour(const WallLook& look, const Brick& brick) {
  const uint32_t seed = look.wall;
  const auto draw = [&](int k) { return Normal(brick.column, brick.row, seed + 13 * k); };
  constexpr float kSpread = 0.6f;  // a pixel of the picture averages several bricks
  Colour colour = Pick(look.palette, kSpread * draw(1), kSpread * draw(2), draw(3));
  colour = colour * Tone(0.07f * draw(6));
  const float kind = Uniform(brick.column, brick.row, seed + 91);
  if (kind < 0.03f) colour = colour * Colour{0.62f, 0.62f, 0.66f};
  if (kind > 0.98f) colour = colour * Colour{1.25f, 1.18f, 1.12f};
  return colour;
}

// The length of brick between 0 and y, in a wall of courses with joints between them.
float BrickBelow(float y, float joint_m) {
  const int course = Floor(y / kCourse_m);
  const float within = y - static_cast<float>(course) * kCourse_m;
  const float face = kCourse_m - joint_m;
  return static_cast<float>(course) * face + std::clamp(within - joint_m / 2, 0.0f, face);
}

struct Style {
  Bond bond;
  Colour mortar;
  float joint_m;
};

Style StyleOf(const WallLook& look) {
  Style style;
  const float bond = Trait(look, 1);
  style.bond = bond < 0.4f ? Bond::kStretcher : bond < 0.75f ? Bond::kFlemish : Bond::kEnglish;
  const float light = Trait(look, 2);
  // Dust of the bricks and soot bring mortar near the bricks' own colour within years.
  style.mortar = Mix(Mix(FromSrgb(100, 95, 90), FromSrgb(190, 184, 172), light),
                     Pick(look.palette, 0, 0, 0), 0.62f + 0.3f * Trait(look, 4));
  style.joint_m = 0.009f + 0.004f * Trait(look, 3);
  return style;
}

}  // namespace

void PaintSoldierCourse(Tile& tile, const WallLook& look, const Box& box) {
  const Style style = StyleOf(look);
  const float texel = tile.texel_m;
  Fill(tile, box, [&](float x, float y, Colour) {
    const int rank = Floor(x / kCourse_m);
    const float in = x - static_cast<float>(rank) * kCourse_m;
    const uint32_t bits = Hash(Floor(x / texel), Floor(y / texel), look.wall + 23);
    const float white = ToUnit(bits) - 0.5f;
    const float across = Cover(in, style.joint_m / 2, kCourse_m - style.joint_m / 2, texel);
    const float down = Cover(y, box.top + style.joint_m / 2, box.bottom, texel);
    const int storey = Floor(box.top * 8);
    const Colour brick = BrickColour(look, {9000 + storey, rank, 0, 0}) * Tone(0.09f * white);
    return Mix(style.mortar * 0.9f, brick, across * down);
  });
}

void PaintBrick(Tile& tile, const WallLook& look) {
  const Style style = StyleOf(look);
  const float texel = tile.texel_m;
  const Field pointing(tile, StepFor(0.6f, texel), [&](float x, float y) {
    return Noise(x, y, {1.8f, 3, 0.6f, look.wall + 5}, texel);
  });
  const Field wander(tile, StepFor(0.3f, texel), [&](float x, float y) {
    return Noise(x, y, {2.4f, 3, 0.5f, look.wall + 6}, texel);
  });
  const float crisp = BandShare(0.035f, texel);  // what is finer than a brick can be seen
  const float grain = 0.045f * std::min(1.0f, 0.01f / texel);
  for (int row = 0; row < tile.height; ++row) {
    Brick brick{0, 1 << 30, 0, 0};
    Colour colour;
    for (int column = 0; column < tile.width; ++column) {
      const float x = tile.X(column);
      // No mason keeps a course level: it wanders by a few millimetres.
      const float y = tile.Y(row) + 0.006f * wander(column, row);
      const int course = Floor(y / kCourse_m);
      if (x < brick.left || x >= brick.right || course != brick.row) {
        brick = BrickAt(style.bond, x, course);
        colour = BrickColour(look, brick);
      }
      const uint32_t bits = Hash(tile.x0 + column, tile.y0 + row, look.wall + 3);
      const float white = ToUnit(bits) - 0.5f;
      const float rough = 0.007f * (ToUnit(bits * 0x9e3779b1u) - 0.5f);
      const float half = texel / 2;
      const float share_y = (BrickBelow(y + rough + half, style.joint_m) -
                             BrickBelow(y + rough - half, style.joint_m)) /
                            texel;
      const float share_x =
          Cover(x + rough, brick.left + style.joint_m / 2, brick.right - style.joint_m / 2, texel);
      // Raked joints lie in the shade of the brick above.
      const float y_in = y - static_cast<float>(course) * kCourse_m;
      const float shade = Mix(0.87f, y_in < kCourse_m / 2 ? 0.78f : 0.96f, crisp);
      const Colour mortar =
          style.mortar * (shade * Tone(0.16f * pointing(column, row) + 0.16f * white));
      const float face =
          1 + 2 * grain * white + 0.07f * GradientNoise(x * 26, y * 32, look.wall + 19) * crisp;
      tile.At(column, row) = Mix(mortar, colour * face, share_x * share_y);
    }
  }
}

}  // namespace stucco::simulate::internal
