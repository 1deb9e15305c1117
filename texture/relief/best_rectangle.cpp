// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/relief/best_rectangle.h"

#include <algorithm>
#include <cassert>
#include <utility>
#include <vector>

namespace stucco {
namespace {

struct Run {
  int begin = 0;
  int end = 0;
  double sum = 0;
};

// The run of values with the largest sum (Kadane).
Run BestRun(std::span<const double> values) {
  Run best;
  Run now;
  for (int i = 0; std::cmp_less(i, values.size()); ++i) {
    if (now.sum <= 0) now = {i, i, 0};
    now.sum += values[i];
    now.end = i + 1;
    if (now.sum > best.sum) best = now;
  }
  return best;
}

}  // namespace

RectangleSum BestRectangle(std::span<const float> values, int width, int height) {
  assert(std::cmp_equal(values.size(), static_cast<size_t>(width) * height));
  // Bands along the shorter side, runs along the longer one.
  const bool upright = height <= width;
  const int bands = std::min(width, height);
  const int length = std::max(width, height);
  RectangleSum best;
  std::vector<double> sums(length);
  for (int begin = 0; begin < bands; ++begin) {
    std::ranges::fill(sums, 0);
    for (int end = begin + 1; end <= bands; ++end) {
      for (int i = 0; i < length; ++i) {
        sums[i] += upright ? values[static_cast<size_t>(end - 1) * width + i]
                           : values[static_cast<size_t>(i) * width + end - 1];
      }
      const Run run = BestRun(sums);
      if (run.sum <= best.sum) continue;
      best.sum = run.sum;
      best.cells = upright ? CellRectangle{run.begin, begin, run.end, end}
                           : CellRectangle{begin, run.begin, end, run.end};
    }
  }
  return best;
}

}  // namespace stucco
