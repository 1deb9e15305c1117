// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/light/falloff.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <vector>

namespace stucco {
namespace {

constexpr int kShares = 256;  // between the middle and the farthest corner

// Codes by code of what has lost light, at one share.
using Codes = std::array<uint8_t, 256>;

std::vector<Codes> CodesByShare(const Falloff& falloff) {
  std::vector<Codes> tables(kShares);
  for (int s = 0; s < kShares; ++s) {
    const double lost = std::exp(-falloff.LogAt((s + 0.5) / kShares));
    for (int code = 0; code < 256; ++code) {
      tables[s][code] = static_cast<uint8_t>(std::min(255.0, lost * code + 0.5));
    }
  }
  return tables;
}

double FarthestCorner2(const Camera& camera) {
  const Eigen::Vector2d center = camera.PrincipalPoint();
  const double x = std::max(center.x(), camera.width_px - center.x());
  const double y = std::max(center.y(), camera.height_px - center.y());
  return x * x + y * y;
}

}  // namespace

double CornerShare(const Camera& camera, const Eigen::Vector2d& pixel) {
  return (pixel - camera.PrincipalPoint()).squaredNorm() / FarthestCorner2(camera);
}

void EvenOut(const Falloff& falloff, const Camera& camera, Image& picture) {
  if (falloff.IsNone()) return;
  assert(picture.width_px > 0 && picture.height_px > 0);
  const std::vector<Codes> tables = CodesByShare(falloff);
  const double scale_x = static_cast<double>(camera.width_px) / picture.width_px;
  const double scale_y = static_cast<double>(camera.height_px) / picture.height_px;
  const Eigen::Vector2d center = camera.PrincipalPoint();
  const double to_table = kShares / FarthestCorner2(camera);
  for (int y = 0; y < picture.height_px; ++y) {
    const double dy = (y + 0.5) * scale_y - center.y();
    uint8_t* pixel = picture.Pixel(0, y);
    for (int x = 0; x < picture.width_px; ++x, pixel += picture.channels) {
      const double dx = (x + 0.5) * scale_x - center.x();
      const int share = std::min(kShares - 1, static_cast<int>((dx * dx + dy * dy) * to_table));
      for (int c = 0; c < picture.channels; ++c) pixel[c] = tables[share][pixel[c]];
    }
  }
}

}  // namespace stucco
