// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>

#include "simulate/paint/internal/tile.h"
#include "simulate/paint/paint.h"

namespace stucco::simulate {
namespace {

using internal::Colour;
using internal::Hash;
using internal::ToUnit;

struct Leaf {
  float x, y;           // of its middle, 0 to 1 across the picture
  float along, across;  // half lengths
  float cosine, sine;
  float tone, hue;
};

Leaf MakeLeaf(int index, uint32_t seed) {
  const auto draw = [&](int k) { return internal::Uniform(index, k, seed); };
  const float turn = 6.2831853f * draw(0);
  const float length = 0.035f + 0.03f * draw(1);
  // A spray is denser in its middle.
  const float radius = 0.47f * std::sqrt(draw(2));
  const float angle = 6.2831853f * draw(3);
  return {0.5f + radius * std::cos(angle),
          0.5f + radius * std::sin(angle),
          length,
          length * (0.35f + 0.2f * draw(4)),
          std::cos(turn),
          std::sin(turn),
          0.45f + 0.75f * draw(5),
          draw(6)};
}

// Paints one leaf, an ellipse with pointed ends and a light midrib.
void Draw(const Leaf& leaf, const Colour& green, Image& image) {
  const float side = static_cast<float>(image.width_px);
  const int reach = static_cast<int>(leaf.along * side) + 2;
  const int cx = static_cast<int>(leaf.x * side);
  const int cy = static_cast<int>(leaf.y * side);
  for (int y = std::max(0, cy - reach); y < std::min(image.height_px, cy + reach + 1); ++y) {
    for (int x = std::max(0, cx - reach); x < std::min(image.width_px, cx + reach + 1); ++x) {
      const float dx = (static_cast<float>(x) + 0.5f) / side - leaf.x;
      const float dy = (static_cast<float>(y) + 0.5f) / side - leaf.y;
      const float u = (dx * leaf.cosine + dy * leaf.sine) / leaf.along;
      const float v = (dy * leaf.cosine - dx * leaf.sine) / leaf.across;
      if (std::abs(u) >= 1 || std::abs(v) > 1 - u * u) continue;
      const float rib = internal::Smooth(0.18f, 0.0f, std::abs(v));
      const float veins = 0.08f * std::sin(22 * (u + 0.6f * std::abs(v)));
      const Colour colour = green * (leaf.tone * (1 + 0.25f * rib + veins + 0.2f * v)) *
                            Colour{1 + 0.8f * leaf.hue, 1 + 0.15f * leaf.hue, 1};
      uint8_t* to = image.Pixel(x, y);
      to[0] = internal::FastSrgbCode(colour.r);
      to[1] = internal::FastSrgbCode(colour.g);
      to[2] = internal::FastSrgbCode(colour.b);
      to[3] = 255;
    }
  }
}

}  // namespace

Image PaintLeaves(uint64_t seed, int side_px) {
  const int side = std::max(1, side_px);
  Image image{side, side, 4, {}};
  image.data.assign(static_cast<size_t>(side) * side * 4, 0);
  const uint32_t mixed = Hash(seed, 23);
  const Colour green =
      Mix(internal::FromSrgb(58, 88, 36), internal::FromSrgb(104, 122, 52), ToUnit(mixed));
  // The gaps keep a leaf's colour, so that smaller pictures of it have no dark fringe.
  for (size_t i = 0; i < image.data.size(); i += 4) {
    image.data[i] = internal::FastSrgbCode(0.7f * green.r);
    image.data[i + 1] = internal::FastSrgbCode(0.7f * green.g);
    image.data[i + 2] = internal::FastSrgbCode(0.7f * green.b);
  }
  constexpr int kLeaves = 190;
  for (int i = 0; i < kLeaves; ++i) Draw(MakeLeaf(i, mixed), green, image);
  return image;
}

}  // namespace stucco::simulate
