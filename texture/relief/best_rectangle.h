// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

namespace stucco {

// Cells of a raster: columns left to right - 1, rows top to bottom - 1.
struct CellRectangle {
  int left = 0;
  int top = 0;
  int right = 0;
  int bottom = 0;

  int Cells() const { return (right - left) * (bottom - top); }
};

struct RectangleSum {
  CellRectangle cells;
  double sum = 0;
};

// The rectangle with the largest sum of values, by row; an empty one where none is positive. Takes
// time width x height x the smaller of both (Bentley, "Algorithm design techniques", 1984).
RectangleSum BestRectangle(std::span<const float> values, int width, int height);

}  // namespace stucco
