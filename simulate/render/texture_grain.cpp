// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulate/render/internal/texture_grain.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "simulate/paint/internal/noise.h"

namespace stucco::simulate::internal {
namespace {

constexpr int kBlock = 16;  // texels
constexpr float kStrengthUnit = 1 / 500.0f;
// Every octave has 0.75 of the standard deviation of the one before: a spectrum that falls with the
// 2.8th power of the frequency, as that of photos of facades does
// (bench/features_per_megapixel.py).
constexpr float kGain = 0.75f;
// sRGB codes to the logarithm of light: its exponent in the middle of the scale.
constexpr float kGamma = 2.2f;
// Rounding to codes and JPEG leave this much in the mean of four texels.
constexpr float kRounding = 0.3f;

float Grey(const uint8_t* pixel, int channels) {
  return channels < 3 ? pixel[0] : (pixel[0] + 2.0f * pixel[1] + pixel[2]) / 4;
}

// Of the four quarters of 4 x 4 texels.
std::array<float, 4> MeansAt(const Image& image, int left, int top) {
  std::array<float, 4> means = {0, 0, 0, 0};
  for (int y = 0; y < 4; ++y) {
    for (int x = 0; x < 4; ++x) {
      means[2 * (y / 2) + x / 2] += Grey(image.Pixel(left + x, top + y), image.channels) / 4;
    }
  }
  return means;
}

// The standard deviation of the logarithm of light in waves of four to eight texels: of means of
// 2 x 2 texels about those of 4 x 4 (the second octave of Haar's wavelets). From the lower quartile
// of the deviations, 0.3186 of the standard deviation of normal ones, since joints and frames,
// which are no grain, make up less than half of most blocks.
float StrengthOf(const Image& image, int left, int top) {
  std::array<float, kBlock * kBlock / 4> deviations;
  size_t count = 0;
  float sum = 0;
  for (int y = top; y + 4 <= std::min(top + kBlock, image.height_px); y += 4) {
    for (int x = left; x + 4 <= std::min(left + kBlock, image.width_px); x += 4) {
      const std::array<float, 4> means = MeansAt(image, x, y);
      const float mean = (means[0] + means[1] + means[2] + means[3]) / 4;
      for (const float part : means) deviations[count++] = std::abs(part - mean);
      sum += 4 * mean;
    }
  }
  if (count == 0) return 0;
  const auto quartile = deviations.begin() + static_cast<long>(count / 4);
  std::nth_element(deviations.begin(), quartile, deviations.begin() + static_cast<long>(count));
  constexpr float kQuartileOfNormal = 0.3186f;
  const float codes = *quartile / kQuartileOfNormal;
  const float grain = std::sqrt(std::max(0.0f, codes * codes - kRounding * kRounding));
  return kGamma * grain / std::max(sum / static_cast<float>(count), 16.0f);
}

}  // namespace

TextureGrain::TextureGrain(const Image& image, uint32_t seed)
    : width_(static_cast<float>(image.width_px)),
      height_(static_cast<float>(image.height_px)),
      seed_(seed),
      columns_((image.width_px + kBlock - 1) / kBlock),
      rows_((image.height_px + kBlock - 1) / kBlock) {
  for (int row = 0; row < rows_; ++row) {
    for (int column = 0; column < columns_; ++column) {
      const float strength = StrengthOf(image, column * kBlock, row * kBlock);
      strengths_.push_back(
          static_cast<uint8_t>(std::min(std::lround(strength / kStrengthUnit), 255L)));
    }
  }
}

// Linear between the middles of blocks; beyond the texture its first and last blocks go on.
float TextureGrain::StrengthAt(const Eigen::Vector2f& uv) const {
  const auto place = [](float texels, int blocks) {
    return std::clamp(texels / kBlock - 0.5f, 0.0f, static_cast<float>(blocks - 1));
  };
  const float x = place((uv.x() - std::floor(uv.x())) * width_, columns_);
  const float y = place((uv.y() - std::floor(uv.y())) * height_, rows_);
  const int left = static_cast<int>(x);
  const int top = static_cast<int>(y);
  const auto at = [&](int column, int row) {
    const size_t i = static_cast<size_t>(std::min(row, rows_ - 1)) * columns_;
    return static_cast<float>(strengths_[i + std::min(column, columns_ - 1)]);
  };
  const float tx = x - static_cast<float>(left);
  const float upper = Mix(at(left, top), at(left + 1, top), tx);
  const float lower = Mix(at(left, top + 1), at(left + 1, top + 1), tx);
  return kStrengthUnit * Mix(upper, lower, y - static_cast<float>(top));
}

float TextureGrain::At(const Footprint& footprint) const {
  const float pixel = LongerAxis(footprint, width_, height_);
  constexpr float kFirstWave = 2;  // texels; longer ones are in the texture
  // In a hundred thousand texels from the first, floats cannot tell a tenth of a texel any more.
  const Eigen::Vector2f place = footprint.centre.cwiseProduct(Eigen::Vector2f(width_, height_));
  constexpr float kFar = 1e5f;
  if (!(pixel < 1) || !(std::abs(place.x()) < kFar && std::abs(place.y()) < kFar)) return 1;
  const float strength = StrengthAt(footprint.centre);
  if (strength <= 0) return 1;
  const Octaves octaves = {.wavelength_m = kFirstWave, .count = 6, .gain = kGain, .seed = seed_};
  // The mean of exp(n) is 1 + variance / 2: a factor of 1 + n keeps the texture's mean.
  constexpr float kLeast = 0.25f;
  const float noise = strength * kGain * Noise(place.x(), place.y(), octaves, pixel);
  return std::clamp(1 + noise, kLeast, 2 - kLeast);
}

}  // namespace stucco::simulate::internal
