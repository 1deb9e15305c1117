// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>

#include "simulate/paint/internal/wall_look.h"

namespace stucco::simulate::internal {
namespace {

// Houses opposite are this wide, their storeys and axes of windows this far apart.
constexpr float kHouse_m = 9;
constexpr float kStorey_m = 3.1f;
constexpr float kAxis_m = 2.3f;

// How much of a bump of half width `half` around 0.5 is at a share `t` of a period.
float Bump(float t, float half, float soft) {
  return Smooth(half + soft, half - soft, std::abs(t - 0.5f));
}

Colour Opposite(float x, float y, int house, uint32_t seed) {
  const Colour wall = Mix(FromSrgb(112, 98, 86), FromSrgb(168, 160, 148), Uniform(house, 1, seed)) *
                      (0.5f + 0.5f * Uniform(house, 2, seed));
  const int axis = Floor(x / kAxis_m);
  const int storey = Floor(y / kStorey_m);
  const float u = x / kAxis_m - static_cast<float>(axis);
  const float v = y / kStorey_m - static_cast<float>(storey);
  const Colour pane =
      Grey(0.02f + 0.25f * Uniform(axis, storey, seed) * Uniform(storey, axis, seed));
  const Colour front = Mix(wall, pane, Bump(u, 0.24f, 0.02f) * Bump(v, 0.27f, 0.02f));
  return front;
}

struct Grid {
  float width_m = 1.4f;
  std::vector<float> lines_m;  // of transoms, from the top downwards, the wall's edges included
};

// Two panes a storey: a tall one to look through and a low one in front of the slab.
Grid GridOf(const WallLook& look) {
  Grid grid;
  grid.width_m = 1.1f + 0.7f * Trait(look, 1);
  grid.lines_m.push_back(0);
  std::vector<double> floors = look.design->floors_m;
  if (floors.empty()) {
    for (double y = 3.4; y < look.height_m; y += 3.4) floors.push_back(y);
  }
  for (const double floor : floors) {
    const float y = static_cast<float>(floor);
    if (y - 0.9f > grid.lines_m.back()) grid.lines_m.push_back(y - 0.9f);
    if (y > grid.lines_m.back()) grid.lines_m.push_back(y);
  }
  grid.lines_m.push_back(look.height_m + 1);
  return grid;
}

// Light that comes from rooms: rows of lamps under the ceiling, some rooms dark, and desks.
Colour Office(float x, float down, float height, uint32_t seed) {
  const int room = Floor(x / 5.6f);
  const float lit = Uniform(room, 3, seed) < 0.55f ? 0.5f + 0.5f * Uniform(room, 4, seed) : 0.0f;
  constexpr float kLamp_m = 1.1f;
  const float in = x - kLamp_m * static_cast<float>(Floor(x / kLamp_m));
  const float row = down - 0.14f - 0.2f * static_cast<float>(Floor((down - 0.14f) / 0.2f));
  const bool lamp = down > 0.14f && down < 0.6f && in > 0.2f && in < 0.75f && row < 0.045f;
  const int thing = Floor(x / 0.42f);
  const float desk = 0.25f + 0.35f * Uniform(thing, 5, seed);
  const bool shade = height - down < desk && Uniform(thing, 6, seed) < 0.6f;
  return FromSrgb(236, 232, 214) * (lit * (lamp ? 0.7f : shade ? 0.02f : 0.07f));
}

}  // namespace

Colour Mirrored(float x, float y, float horizon_y, uint32_t seed) {
  const float up = horizon_y - y;
  const int house = Floor(x / kHouse_m);
  const float roof = 1 + 6 * Uniform(house, 0, seed);
  if (up < roof - 0.05f) return Opposite(x, y, house, seed);
  const float cloud = Smooth(-0.6f, 1.4f, Noise(x, 1.6f * y, {9, 3, 0.55f, seed + 1}, 0.08f));
  const Colour sky = Mix(FromSrgb(128, 152, 186), FromSrgb(208, 214, 220), cloud) *
                     (0.75f + 0.25f * Smooth(0, 25, up));
  return Mix(Opposite(x, y, house, seed), sky, Smooth(roof - 0.05f, roof + 0.05f, up));
}

void PaintCurtainWall(Tile& tile, const WallLook& look) {
  const float texel = tile.texel_m;
  const Grid grid = GridOf(look);
  const std::vector<Pane>& rooms = Facades().windows;
  const Colour tint = Pick(look.palette, 0, 0, 0);
  // The coating colours what it mirrors, though less than the picture's blue sky would tell.
  const Colour glass = Mix(tint * (1 / std::max(0.05f, Luminance(tint))), Grey(1), 0.6f);
  // How much of the picture is mirrored; what the pane mirrors by its angle comes from its gloss.
  const float opacity = 0.2f + 0.3f * Trait(look, 2);
  const Colour metal = look.surround;
  const float bar = 0.025f + 0.02f * Trait(look, 4);
  for (int row = 0; row < tile.height; ++row) {
    const float y = tile.Y(row);
    const auto above = std::upper_bound(grid.lines_m.begin(), grid.lines_m.end(), y) - 1;
    const int level = static_cast<int>(above - grid.lines_m.begin());
    const float top = *above;
    const float bottom = *(above + 1);
    const bool spandrel = bottom - top < 1.0f;
    for (int column = 0; column < tile.width; ++column) {
      const float x = tile.X(column);
      const int pane = Floor(x / grid.width_m);
      const float left = static_cast<float>(pane) * grid.width_m;
      const auto draw = [&](int k) { return Uniform(pane, level, look.wall + 50 + k); };
      // No two panes stand quite alike: each mirrors another piece of the sky.
      const float dx = 3 * (draw(0) - 0.5f) + (0.5f + draw(6)) * (x - left - grid.width_m / 2);
      const float dy = 2 * (draw(1) - 0.5f);
      const Colour mirrored =
          Mirrored(x + dx, y + dy, look.height_m * 0.8f, look.building + 9) * glass;
      const float u = (x - left) / grid.width_m;
      const float v = (y - top) / (bottom - top);
      Colour inside = spandrel ? glass * 0.06f
                               : At(rooms[Hash(pane, level, look.wall) % rooms.size()], u, v) *
                                     (0.25f + 0.5f * draw(2));
      if (!spandrel) inside = inside + Office(x, y - top, bottom - top, Hash(level, 8, look.wall));
      const float blind = draw(3) < 0.35f && !spandrel ? 0.2f + 0.8f * draw(4) : 0.0f;
      if (v < blind) {
        const float slat = y * 28 - static_cast<float>(Floor(y * 28));
        inside = Grey(0.42f + 0.2f * draw(5)) *
                 Mix(0.85f, 0.55f + 0.45f * Smooth(0, 0.6f, slat), BandShare(0.036f, texel));
      }
      const float edge =
          std::min(std::min(x - left, left + grid.width_m - x), std::min(y - top, bottom - y));
      const float white = Normal(tile.x0 + column, tile.y0 + row, look.wall + 3);
      const Colour face = Mix(inside, mirrored, opacity) * Tone(0.012f * white);
      const float gasket = Edge(bar + 0.012f - edge, texel);
      Colour result = Mix(face, Grey(0.02f), gasket);
      result = Mix(result, metal * Tone(0.03f * white + 0.1f * (draw(7) - 0.5f)),
                   Edge(bar - edge, texel));
      tile.At(column, row) = result;
    }
  }
}

}  // namespace stucco::simulate::internal
