// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/painting/fill.h"

#include <algorithm>

namespace stucco {
namespace {

// Sums of weight * colour and of weights.
struct Weighted {
  int width = 0;
  int height = 0;
  std::vector<float> rgb;
  std::vector<float> weight;
};

// 2 x 2 means of what is known.
Weighted Pulled(const Weighted& fine) {
  Weighted coarse;
  coarse.width = (fine.width + 1) / 2;
  coarse.height = (fine.height + 1) / 2;
  const size_t count = static_cast<size_t>(coarse.width) * coarse.height;
  coarse.rgb.assign(3 * count, 0);
  coarse.weight.assign(count, 0);
  for (int y = 0; y < fine.height; ++y) {
    for (int x = 0; x < fine.width; ++x) {
      const size_t from = static_cast<size_t>(y) * fine.width + x;
      const size_t to = static_cast<size_t>(y / 2) * coarse.width + x / 2;
      for (int k = 0; k < 3; ++k) {
        coarse.rgb[3 * to + k] += fine.weight[from] * fine.rgb[3 * from + k];
      }
      coarse.weight[to] += fine.weight[from];
    }
  }
  for (size_t i = 0; i < count; ++i) {
    if (!(coarse.weight[i] > 0)) continue;
    for (int k = 0; k < 3; ++k) coarse.rgb[3 * i + k] /= coarse.weight[i];
    coarse.weight[i] = std::min(1.0f, coarse.weight[i]);
  }
  return coarse;
}

// Bilinear value of a coarse level at the centre of a fine texel.
void Interpolate(const Weighted& coarse, int x, int y, float* rgb) {
  const float fx = std::clamp((x + 0.5f) / 2 - 0.5f, 0.0f, static_cast<float>(coarse.width - 1));
  const float fy = std::clamp((y + 0.5f) / 2 - 0.5f, 0.0f, static_cast<float>(coarse.height - 1));
  const int x0 = static_cast<int>(fx);
  const int y0 = static_cast<int>(fy);
  const int x1 = std::min(x0 + 1, coarse.width - 1);
  const int y1 = std::min(y0 + 1, coarse.height - 1);
  const float s = fx - static_cast<float>(x0);
  const float t = fy - static_cast<float>(y0);
  const auto at = [&](int column, int row) {
    return &coarse.rgb[3 * (static_cast<size_t>(row) * coarse.width + column)];
  };
  for (int k = 0; k < 3; ++k) {
    rgb[k] = (1 - t) * ((1 - s) * at(x0, y0)[k] + s * at(x1, y0)[k]) +
             t * ((1 - s) * at(x0, y1)[k] + s * at(x1, y1)[k]);
  }
}

void Push(const Weighted& coarse, Weighted& fine) {
  for (int y = 0; y < fine.height; ++y) {
    for (int x = 0; x < fine.width; ++x) {
      const size_t i = static_cast<size_t>(y) * fine.width + x;
      if (fine.weight[i] >= 1) continue;
      float from_coarse[3];
      Interpolate(coarse, x, y, from_coarse);
      const float own = fine.weight[i];
      for (int k = 0; k < 3; ++k) {
        fine.rgb[3 * i + k] = own * fine.rgb[3 * i + k] + (1 - own) * from_coarse[k];
      }
      fine.weight[i] = 1;
    }
  }
}

}  // namespace

void FillSmoothly(std::vector<float>& rgb, const std::vector<uint8_t>& known, int width,
                  int height) {
  if (std::none_of(known.begin(), known.end(), [](uint8_t k) { return k != 0; })) return;
  std::vector<Weighted> levels(1);
  levels[0].width = width;
  levels[0].height = height;
  levels[0].rgb.swap(rgb);
  levels[0].weight.resize(known.size());
  std::transform(known.begin(), known.end(), levels[0].weight.begin(),
                 [](uint8_t k) { return k != 0 ? 1.0f : 0.0f; });
  while (levels.back().width > 1 || levels.back().height > 1) {
    levels.push_back(Pulled(levels.back()));
  }
  for (size_t level = levels.size() - 1; level-- > 0;) Push(levels[level + 1], levels[level]);
  rgb.swap(levels[0].rgb);
}

namespace {

// A picture of half the size, each texel the mean of those known among its four, without gaps.
Weighted HalvedAndFilled(const Image& picture, const std::vector<uint8_t>& known) {
  Weighted half;
  half.width = (picture.width_px + 1) / 2;
  half.height = (picture.height_px + 1) / 2;
  const size_t count = static_cast<size_t>(half.width) * half.height;
  half.rgb.assign(3 * count, 0);
  half.weight.assign(count, 0);
  for (int y = 0; y < picture.height_px; ++y) {
    for (int x = 0; x < picture.width_px; ++x) {
      if (!known[static_cast<size_t>(y) * picture.width_px + x]) continue;
      const size_t to = static_cast<size_t>(y / 2) * half.width + x / 2;
      for (int k = 0; k < 3; ++k) half.rgb[3 * to + k] += picture.Pixel(x, y)[k];
      half.weight[to] += 1;
    }
  }
  std::vector<uint8_t> half_known(count);
  for (size_t i = 0; i < count; ++i) {
    half_known[i] = half.weight[i] > 0;
    if (!half_known[i]) continue;
    for (int k = 0; k < 3; ++k) half.rgb[3 * i + k] /= half.weight[i];
  }
  FillSmoothly(half.rgb, half_known, half.width, half.height);
  return half;
}

}  // namespace

void FillPictureSmoothly(Image& picture, const std::vector<uint8_t>& known) {
  if (std::all_of(known.begin(), known.end(), [](uint8_t k) { return k != 0; })) return;
  const Weighted half = HalvedAndFilled(picture, known);
  for (int y = 0; y < picture.height_px; ++y) {
    for (int x = 0; x < picture.width_px; ++x) {
      if (known[static_cast<size_t>(y) * picture.width_px + x]) continue;
      float rgb[3];
      Interpolate(half, x, y, rgb);
      for (int k = 0; k < 3; ++k) {
        picture.Pixel(x, y)[k] = static_cast<uint8_t>(std::clamp(rgb[k] + 0.5f, 0.0f, 255.0f));
      }
    }
  }
}

}  // namespace stucco
