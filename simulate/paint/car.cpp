// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>
#include <cmath>

#include "simulate/floor.h"
#include "simulate/paint/car_shape.h"
#include "simulate/paint/internal/openings.h"
#include "simulate/paint/internal/tile.h"
#include "simulate/paint/paint.h"

namespace stucco::simulate {
namespace {

using internal::Box;
using internal::Colour;
using internal::Edge;
using internal::Grey;
using internal::Smooth;
using internal::Tile;

constexpr float kLength_m = kCarLength_m;
constexpr float kWidth_m = kCarWidth_m;
const Colour kPlastic = Grey(0.012f);
const Colour kGap = Grey(0.008f);

Colour Lacquer(uint32_t seed) {
  // Shares follow what is on European roads: greys, white and black first.
  constexpr std::array<std::array<uint8_t, 3>, 10> kColours = {{{200, 202, 204},
                                                                {222, 222, 220},
                                                                {34, 35, 38},
                                                                {84, 88, 92},
                                                                {132, 136, 140},
                                                                {40, 62, 104},
                                                                {112, 32, 34},
                                                                {58, 74, 62},
                                                                {150, 128, 96},
                                                                {24, 26, 30}}};
  const auto& c = kColours[seed % kColours.size()];
  return internal::FromSrgb(c[0], c[1], c[2]);
}

// What all views of a car share.
struct CarLook {
  CarShape shape;
  uint32_t seed = 0;
  Colour lacquer;
};

// x of a side of the outline at height y: where the pillars stand.
float XAt(const Eigen::Vector2d& foot, const Eigen::Vector2d& top, float y) {
  const double t = (y - foot.y()) / (top.y() - foot.y());
  return static_cast<float>(foot.x() + t * (top.x() - foot.x()));
}

// Glass mirrors the sky in its upper part.
Colour Pane(float share_up) {
  return Mix(Grey(0.015f), Grey(0.12f), 0.5f * Smooth(0.2f, 1, share_up));
}

void PaintSideWindows(Tile& tile, const CarLook& look, float belt) {
  const auto& outline = look.shape.outline;
  const auto& front_foot = outline[look.shape.windscreen];
  const auto& front_top = outline[look.shape.windscreen + 1];
  const auto& rear_top = outline[look.shape.rear_window];
  const auto& rear_foot = outline[look.shape.rear_window + 1];
  constexpr float kPillar_m = 0.1f;
  constexpr float kRoof_m = 0.22f;
  Fill(tile, {0.9f, kRoof_m, kLength_m, belt}, [&](float x, float y, Colour under) {
    const float front = x - XAt(front_foot, front_top, y) - kPillar_m;
    const float back = XAt(rear_foot, rear_top, y) - kPillar_m - x;
    const float glass = Edge(std::min(front, back), tile.texel_m);
    return Mix(under, Pane((belt - y) / (belt - kRoof_m)), glass);
  });
  for (const float pillar : {2.05f, 3.05f}) {
    if (pillar + 0.1f > XAt(rear_foot, rear_top, kRoof_m)) continue;
    Fill(tile, {pillar - 0.04f, kRoof_m, pillar + 0.04f, belt}, Grey(0.01f));
  }
}

void PaintSide(Tile& tile, const CarLook& look) {
  const float texel = tile.texel_m;
  const float belt = static_cast<float>(look.shape.outline[look.shape.windscreen].y());
  Fill(tile, {0, 0, kLength_m, kCarHeight_m}, [&](float x, float y, Colour) {
    // The upper half of the flank mirrors the sky, the lower the road.
    const float sky = 0.25f * Smooth(0.95f, 0.55f, y) - 0.3f * Smooth(0.8f, 1.2f, y);
    const float dirt = 0.3f * Smooth(0.9f, 1.4f, y) *
                       (1 + 0.4f * internal::Noise(x, y, {0.3f, 5, 0.7f, look.seed}, texel));
    return Mix(look.lacquer * internal::Tone(sky), internal::FromSrgb(120, 110, 96), dirt);
  });
  PaintSideWindows(tile, look, belt);
  for (const float gap : {1.2f, 2.05f, 3.05f}) {
    Fill(tile, {gap - 0.006f, belt, gap + 0.006f, 1.2f}, look.lacquer * 0.2f);
  }
  for (const float handle : {1.85f, 2.85f}) {
    Fill(tile, {handle, 0.72f, handle + 0.16f, 0.75f}, look.lacquer * 0.45f);
  }
  Fill(tile, {0.02f, 0.76f, 0.3f, 0.88f}, Grey(0.5f));
  Fill(tile, {4.2f, 0.70f, 4.4f, 0.9f}, internal::FromSrgb(130, 22, 24));
  Fill(tile, {0, 1.22f, kLength_m, kCarHeight_m}, kPlastic);
  for (const float wheel : {0.85f, 3.5f}) {
    Fill(tile, {wheel - 0.4f, 0.8f, wheel + 0.4f, kCarHeight_m}, [&](float x, float y, Colour u) {
      const float radius = std::hypot(x - wheel, y - 1.18f);
      const float spoke = std::sin(5 * std::atan2(y - 1.18f, x - wheel));
      Colour colour = Mix(u, Grey(0.008f), Edge(0.37f - radius, texel));
      colour = Mix(colour, Grey(spoke > 0 ? 0.4f : 0.04f), Edge(0.21f - radius, texel));
      return Mix(colour, Grey(0.2f), Edge(0.05f - radius, texel));
    });
  }
}

// Nose and tail, from `left` on: bumper, lights at both sides, plate, and a grille or a lid.
void PaintEnd(Tile& tile, const CarLook& look, float left, bool tail) {
  const float top = kCarEndsTop_m;
  const float middle = left + kWidth_m / 2;
  const Box all = {left, top, left + kWidth_m, top + static_cast<float>(kCarHeight_m)};
  Fill(tile, all, [&](float, float y, Colour) {
    return look.lacquer * internal::Tone(0.2f * Smooth(0.9f, 0.65f, y - top));
  });
  const Colour lamp = tail ? internal::FromSrgb(130, 22, 24) : Grey(0.5f);
  for (const float side : {-1.0f, 1.0f}) {
    const float x = middle + side * 0.62f;
    internal::PaintBar(tile, {x - 0.17f, top + 0.76f, x + 0.17f, top + 0.9f}, lamp, look.seed);
  }
  if (tail) {
    const auto& foot = look.shape.outline[look.shape.rear_window + 1];
    const float belt = top + static_cast<float>(foot.y());
    Fill(tile, {left + 0.3f, top + 0.24f, all.right - 0.3f, belt - 0.04f},
         [&](float, float y, Colour) { return Pane((belt - y) / 0.4f); });
    Fill(tile, {left + 0.2f, top + 1.0f, all.right - 0.2f, top + 1.012f}, kGap);
  } else {
    Fill(tile, {middle - 0.42f, top + 0.8f, middle + 0.42f, top + 0.92f},
         [&](float, float y, Colour) {
           const float slat = y * 40 - static_cast<float>(Floor(y * 40));
           return Grey(slat < 0.4f ? 0.06f : 0.01f);
         });
  }
  Fill(tile, {left, top + 1.16f, all.right, all.bottom}, kPlastic);
  const Box plate = {middle - 0.26f, top + 1.03f, middle + 0.26f, top + 1.14f};
  Fill(tile, plate, Grey(0.62f));
  internal::PaintLetters(tile, internal::Inset(plate, 0.03f), kGap, look.seed);
}

void PaintRoof(Tile& tile, const CarLook& look) {
  const auto& outline = look.shape.outline;
  const float top = kCarRoofTop_m;
  const Box all = {0, top, kLength_m, top + kWidth_m};
  const auto x_of = [&](int corner) { return static_cast<float>(outline[corner].x()); };
  Fill(tile, all, [&](float x, float y, Colour) {
    const float dust = 0.04f * internal::Noise(x, y, {0.7f, 5, 0.6f, look.seed + 3}, tile.texel_m);
    return look.lacquer * internal::Tone(0.06f + dust);
  });
  const auto glass = [&](float from, float to, float narrow) {
    Fill(tile, {from + 0.03f, top + narrow, to - 0.03f, all.bottom - narrow},
         [&](float x, float, Colour) { return Pane((x - from) / (to - from)); });
  };
  const float hood = x_of(look.shape.windscreen);
  glass(hood, x_of(look.shape.windscreen + 1), 0.2f);
  glass(x_of(look.shape.rear_window), x_of(look.shape.rear_window + 1), 0.24f);
  Fill(tile, {hood - 0.05f, top + 0.1f, hood + 0.03f, all.bottom - 0.1f}, kGap);  // wipers
  for (const float y : {top + 0.14f, all.bottom - 0.14f}) {
    Fill(tile, {0.25f, y - 0.006f, hood, y + 0.006f}, kGap);
  }
  for (const float y : {top + 0.3f, all.bottom - 0.3f}) {  // roof rails
    Fill(tile,
         {x_of(look.shape.windscreen + 1) + 0.05f, y - 0.015f, x_of(look.shape.rear_window) - 0.05f,
          y + 0.015f},
         look.lacquer * 0.4f);
  }
}

}  // namespace

Image PaintCar(uint64_t seed, double metres_per_texel) {
  CarLook look;
  look.shape = ShapeOfCar(seed);
  look.seed = internal::Hash(seed, 37);
  look.lacquer = Lacquer(look.seed);
  Tile tile{0,
            0,
            Texels(kCarLength_m, metres_per_texel),
            Texels(kCarPicture_m, metres_per_texel),
            static_cast<float>(metres_per_texel),
            {}};
  tile.colours.assign(static_cast<size_t>(tile.width) * tile.height, look.lacquer);
  PaintSide(tile, look);
  PaintEnd(tile, look, 0, /*tail=*/false);
  PaintEnd(tile, look, kWidth_m, /*tail=*/true);
  PaintRoof(tile, look);
  Image image{tile.width, tile.height, 3, {}};
  for (const Colour& colour : tile.colours) {
    image.data.push_back(internal::FastSrgbCode(colour.r));
    image.data.push_back(internal::FastSrgbCode(colour.g));
    image.data.push_back(internal::FastSrgbCode(colour.b));
  }
  return image;
}

}  // namespace stucco::simulate
