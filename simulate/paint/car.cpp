// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>
#include <cmath>

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

constexpr double kLength_m = 4.4;
constexpr double kHeight_m = 1.5;

Colour Lacquer(uint32_t seed) {
  // Shares follow what is on European roads: greys, white and black first.
  constexpr std::array<std::array<uint8_t, 3>, 10> kColours = {{{200, 202, 204},
                                                                {222, 222, 220},
                                                                {34, 35, 38},
                                                                {84, 88, 92},
                                                                {132, 136, 140},
                                                                {40, 62, 104},
                                                                {128, 28, 30},
                                                                {58, 74, 62},
                                                                {150, 128, 96},
                                                                {24, 26, 30}}};
  const auto& c = kColours[seed % kColours.size()];
  return internal::FromSrgb(c[0], c[1], c[2]);
}

}  // namespace

Image PaintCar(uint64_t seed, double metres_per_texel) {
  const uint32_t mixed = internal::Hash(seed, 37);
  const Colour lacquer = Lacquer(mixed);
  const float texel = static_cast<float>(metres_per_texel);
  Tile tile{0,     0, Texels(kLength_m, metres_per_texel), Texels(kHeight_m, metres_per_texel),
            texel, {}};
  tile.colours.assign(static_cast<size_t>(tile.width) * tile.height, lacquer);
  Fill(tile, tile.Extent(), [&](float x, float y, Colour) {
    // The upper half of the flank mirrors the sky, the lower the road.
    const float sky = 0.25f * Smooth(0.95f, 0.55f, y) - 0.3f * Smooth(0.8f, 1.2f, y);
    const float dirt = 0.3f * Smooth(0.9f, 1.4f, y) *
                       (1 + 0.4f * internal::Noise(x, y, {0.3f, 5, 0.7f, mixed}, texel));
    return Mix(lacquer * internal::Tone(sky), internal::FromSrgb(120, 110, 96), dirt);
  });
  const float tail = 3.6f + 0.7f * internal::ToUnit(mixed * 0x9e3779b1u);  // saloon to estate
  const float low = 0.58f + 0.08f * internal::ToUnit(mixed * 0x85ebca77u);
  const Box cabin = {0.95f, 0.12f, tail, low};
  Fill(tile, cabin, [&](float x, float y, Colour under) {
    const float front = x - cabin.left - 0.9f * (cabin.bottom - y);
    const float back = cabin.right - x - 0.5f * (cabin.bottom - y);
    const float glass = Edge(std::min(front, back), texel);
    const Colour pane = Mix(Grey(0.015f), Grey(0.3f), Smooth(0.62f, 0.1f, y) * 0.35f);
    return Mix(under, pane, glass);
  });
  for (const float pillar : {2.05f, 3.05f}) {
    Fill(tile, {pillar - 0.04f, cabin.top, pillar + 0.04f, cabin.bottom}, Grey(0.01f));
  }
  for (const float gap : {1.2f, 2.05f, 3.05f}) {
    Fill(tile, {gap - 0.004f, low, gap + 0.004f, 1.2f}, lacquer * 0.2f);
  }
  for (const float handle : {1.85f, 2.85f}) {
    Fill(tile, {handle, 0.72f, handle + 0.16f, 0.75f}, lacquer * 0.45f);
  }
  Fill(tile, {0.02f, 0.72f, 0.32f, 0.86f}, Grey(0.55f));
  Fill(tile, {4.2f, 0.70f, 4.38f, 0.9f}, internal::FromSrgb(150, 20, 20));
  Fill(tile, {0, 1.25f, kLength_m, kHeight_m}, Grey(0.012f));
  for (const float wheel : {0.85f, 3.5f}) {
    Fill(tile, {wheel - 0.4f, 0.8f, wheel + 0.4f, kHeight_m}, [&](float x, float y, Colour under) {
      const float radius = std::hypot(x - wheel, y - 1.18f);
      const float spoke = std::sin(5 * std::atan2(y - 1.18f, x - wheel));
      Colour colour = Mix(under, Grey(0.008f), Edge(0.37f - radius, texel));
      colour = Mix(colour, Grey(spoke > 0 ? 0.4f : 0.04f), Edge(0.21f - radius, texel));
      return Mix(colour, Grey(0.2f), Edge(0.05f - radius, texel));
    });
  }
  Image image{tile.width, tile.height, 3, {}};
  for (const Colour& colour : tile.colours) {
    image.data.push_back(internal::FastSrgbCode(colour.r));
    image.data.push_back(internal::FastSrgbCode(colour.g));
    image.data.push_back(internal::FastSrgbCode(colour.b));
  }
  return image;
}

}  // namespace stucco::simulate
