// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/rasterize.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace stucco {
namespace {

// Columns where the row's centre line crosses the ring's edges.
void AddCrossings(const std::vector<Eigen::Vector2d>& ring, double y, std::vector<double>& out) {
  for (size_t i = 0; i < ring.size(); ++i) {
    const Eigen::Vector2d& a = ring[i];
    const Eigen::Vector2d& b = ring[(i + 1) % ring.size()];
    if ((a.y() <= y) == (b.y() <= y)) continue;
    out.push_back(a.x() + (y - a.y()) / (b.y() - a.y()) * (b.x() - a.x()));
  }
}

}  // namespace

std::vector<uint8_t> RasterizeRings(std::span<const std::vector<Eigen::Vector2d>> rings,
                                    int width_px, int height_px) {
  assert(width_px >= 0 && height_px >= 0);
  std::vector<uint8_t> mask(static_cast<size_t>(width_px) * height_px, 0);
  std::vector<double> crossings;
  // The first column whose centre is not left of x.
  const auto column = [&](double x) {
    return static_cast<int>(std::clamp(std::ceil(x - 0.5), 0.0, static_cast<double>(width_px)));
  };
  for (int row = 0; row < height_px; ++row) {
    crossings.clear();
    for (const auto& ring : rings) AddCrossings(ring, row + 0.5, crossings);
    std::sort(crossings.begin(), crossings.end());
    uint8_t* pixels = mask.data() + static_cast<size_t>(row) * width_px;
    for (size_t i = 0; i + 1 < crossings.size(); i += 2) {
      std::fill(pixels + column(crossings[i]), pixels + column(crossings[i + 1]), uint8_t{1});
    }
  }
  return mask;
}

}  // namespace stucco
