// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulate/flight/sharpen.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "survey/parallel.h"

namespace stucco::simulate {
namespace {

// Half of a Gaussian with a standard deviation of 1 pixel, kGauss[0] in the middle; sums to 1.
constexpr std::array<float, 4> kGauss = {0.399050f, 0.242036f, 0.054006f, 0.004433f};
constexpr int kReach = static_cast<int>(kGauss.size()) - 1;
// Halos: within 5 x 5 pixels, by how much of their range a pixel may leave it.
constexpr int kNear = 2;
constexpr float kHalo = 0.1f;

// Brightness as JPEGs define it (ITU-R BT.601), 0 to 255.
std::vector<float> LumaOf(const Image& picture, int threads) {
  const auto width = static_cast<size_t>(picture.width_px);
  std::vector<float> luma(width * picture.height_px);
  ParallelFor(static_cast<size_t>(picture.height_px), threads, [&](size_t y) {
    for (size_t i = y * width; i < (y + 1) * width; ++i) {
      const uint8_t* rgb = &picture.data[3 * i];
      luma[i] = static_cast<float>(299 * rgb[0] + 587 * rgb[1] + 114 * rgb[2]) / 1000;
    }
  });
  return luma;
}

// What the rows around a row hold, column by column.
struct Columns {
  std::vector<float> mean, least, most;
};

// Rows beyond the picture repeat its first and last.
Columns ColumnsAround(const std::vector<float>& luma, size_t width, int rows, int y) {
  const auto row = [&](int at) { return &luma[width * std::clamp(at, 0, rows - 1)]; };
  Columns columns{std::vector<float>(width), {row(y), row(y) + width}, {row(y), row(y) + width}};
  for (size_t x = 0; x < width; ++x) columns.mean[x] = kGauss[0] * row(y)[x];
  for (int k = 1; k <= kReach; ++k) {
    const float* above = row(y - k);
    const float* below = row(y + k);
    for (size_t x = 0; x < width; ++x) columns.mean[x] += kGauss[k] * (above[x] + below[x]);
    if (k > kNear) continue;
    for (size_t x = 0; x < width; ++x) {
      columns.least[x] = std::min({columns.least[x], above[x], below[x]});
      columns.most[x] = std::max({columns.most[x], above[x], below[x]});
    }
  }
  return columns;
}

void SharpenRow(const std::vector<float>& luma, float strength, int y, Image& picture) {
  const int width = picture.width_px;
  const Columns columns = ColumnsAround(luma, static_cast<size_t>(width), picture.height_px, y);
  for (int x = 0; x < width; ++x) {
    float mean = kGauss[0] * columns.mean[x];
    float least = columns.least[x];
    float most = columns.most[x];
    for (int k = 1; k <= kReach; ++k) {
      const int left = std::max(0, x - k);
      const int right = std::min(width - 1, x + k);
      mean += kGauss[k] * (columns.mean[left] + columns.mean[right]);
      if (k > kNear) continue;
      least = std::min({least, columns.least[left], columns.least[right]});
      most = std::max({most, columns.most[left], columns.most[right]});
    }
    const float before = luma[static_cast<size_t>(y) * width + x];
    const float halo = kHalo * (most - least);
    const float after = std::clamp(before + strength * (before - mean), least - halo, most + halo);
    // The same step for all three leaves the colour as it is.
    const int step = static_cast<int>(std::lround(after - before));
    uint8_t* rgb = picture.Pixel(x, y);
    for (int c = 0; c < 3; ++c) rgb[c] = static_cast<uint8_t>(std::clamp(rgb[c] + step, 0, 255));
  }
}

}  // namespace

Image Sharpened(Image picture, double strength, int threads) {
  if (!(strength > 0)) return picture;
  const std::vector<float> luma = LumaOf(picture, threads);
  ParallelFor(static_cast<size_t>(picture.height_px), threads, [&](size_t y) {
    SharpenRow(luma, static_cast<float>(strength), static_cast<int>(y), picture);
  });
  return picture;
}

}  // namespace stucco::simulate
