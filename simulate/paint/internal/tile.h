// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "simulate/paint/internal/colour.h"
#include "simulate/paint/internal/noise.h"

namespace stucco::simulate::internal {

// In metres on the picture, x right, y down.
struct Box {
  float left = 0;
  float top = 0;
  float right = 0;
  float bottom = 0;
  float Width() const { return right - left; }
  float Height() const { return bottom - top; }
};

inline Box Inset(Box box, float by_m) {
  return {box.left + by_m, box.top + by_m, box.right - by_m, box.bottom - by_m};
}

// A piece of a picture being painted. Everything is painted by its place on the whole picture, so
// the cut into tiles is not seen; a tile fits into the cache and keeps linear light affordable.
struct Tile {
  int x0 = 0;  // column and row of its first texel on the whole picture
  int y0 = 0;
  int width = 0;
  int height = 0;
  float texel_m = 0.01f;
  std::vector<Colour> colours;

  float X(int column) const { return (static_cast<float>(x0 + column) + 0.5f) * texel_m; }
  float Y(int row) const { return (static_cast<float>(y0 + row) + 0.5f) * texel_m; }
  Colour& At(int column, int row) { return colours[static_cast<size_t>(row) * width + column]; }
  Box Extent() const {
    return {static_cast<float>(x0) * texel_m, static_cast<float>(y0) * texel_m,
            static_cast<float>(x0 + width) * texel_m, static_cast<float>(y0 + height) * texel_m};
  }
};

inline bool Meet(const Box& a, const Box& b) {
  return a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom;
}

// The share of a texel around `x` that lies between `low` and `high`.
inline float Cover(float x, float low, float high, float texel_m) {
  const float half = texel_m / 2;
  return std::clamp((std::min(x + half, high) - std::max(x - half, low)) / texel_m, 0.0f, 1.0f);
}

// The share of a texel that lies inside an edge at the signed distance `inside_m` (positive
// inside).
inline float Edge(float inside_m, float texel_m) {
  return std::clamp(0.5f + inside_m / texel_m, 0.0f, 1.0f);
}

// Columns and rows of `tile` that a box touches.
struct Span2 {
  int left, top, right, bottom;
};
inline Span2 Touched(const Tile& tile, const Box& box) {
  const auto clip = [](float value, int size) {
    return static_cast<int>(std::clamp(value, 0.0f, static_cast<float>(size)));
  };
  const float inverse = 1 / tile.texel_m;
  const float x0 = static_cast<float>(tile.x0);
  const float y0 = static_cast<float>(tile.y0);
  return {clip(std::floor(box.left * inverse) - x0, tile.width),
          clip(std::floor(box.top * inverse) - y0, tile.height),
          clip(std::ceil(box.right * inverse) - x0, tile.width),
          clip(std::ceil(box.bottom * inverse) - y0, tile.height)};
}

// Paints a box: shade(x, y, colour_under) gives the new colour. Its edges are anti-aliased.
template <class Shade>
void Fill(Tile& tile, const Box& box, Shade shade) {
  const Span2 span = Touched(tile, box);
  for (int row = span.top; row < span.bottom; ++row) {
    const float y = tile.Y(row);
    const float cover_y = Cover(y, box.top, box.bottom, tile.texel_m);
    for (int column = span.left; column < span.right; ++column) {
      const float x = tile.X(column);
      const float cover = cover_y * Cover(x, box.left, box.right, tile.texel_m);
      Colour& under = tile.At(column, row);
      under = Mix(under, shade(x, y, under), cover);
    }
  }
}

inline void Fill(Tile& tile, const Box& box, Colour colour) {
  Fill(tile, box, [colour](float, float, Colour) { return colour; });
}

// Multiplies what is there: shadows and dirt.
template <class Factor>
void Shade(Tile& tile, const Box& box, Factor factor) {
  const Span2 span = Touched(tile, box);
  for (int row = span.top; row < span.bottom; ++row) {
    for (int column = span.left; column < span.right; ++column) {
      Colour& under = tile.At(column, row);
      under = under * factor(tile.X(column), tile.Y(row));
    }
  }
}

// A slow function of the place, computed at every `step`-th texel of the whole picture and
// interpolated between.
class Field {
 public:
  template <class Function>
  Field(const Tile& tile, int step, Function function)
      : step_(step),
        left_(tile.x0 / step),
        top_(tile.y0 / step),
        columns_((tile.x0 + tile.width) / step + 2 - left_),
        x0_(tile.x0),
        y0_(tile.y0) {
    const int rows = (tile.y0 + tile.height) / step + 2 - top_;
    values_.reserve(static_cast<size_t>(rows) * columns_);
    for (int row = 0; row < rows; ++row) {
      const float y = (static_cast<float>((top_ + row) * step) + 0.5f) * tile.texel_m;
      for (int column = 0; column < columns_; ++column) {
        const float x = (static_cast<float>((left_ + column) * step) + 0.5f) * tile.texel_m;
        values_.push_back(function(x, y));
      }
    }
  }

  // Of a texel of the tile.
  float operator()(int column, int row) const {
    const int x = x0_ + column;
    const int y = y0_ + row;
    const int cell_x = x / step_;
    const int cell_y = y / step_;
    const float scale = 1.0f / static_cast<float>(step_);
    const float u = static_cast<float>(x - cell_x * step_) * scale;
    const float v = static_cast<float>(y - cell_y * step_) * scale;
    const float* at =
        values_.data() + static_cast<size_t>(cell_y - top_) * columns_ + (cell_x - left_);
    return Mix(Mix(at[0], at[1], u), Mix(at[columns_], at[columns_ + 1], u), v);
  }

 private:
  int step_;
  int left_;
  int top_;
  int columns_;
  int x0_;
  int y0_;
  std::vector<float> values_;
};

// The step of a Field whose shortest wave is `wavelength_m`.
inline int StepFor(float wavelength_m, float texel_m) {
  return std::max(1, static_cast<int>(wavelength_m / (6 * texel_m)));
}

}  // namespace stucco::simulate::internal
