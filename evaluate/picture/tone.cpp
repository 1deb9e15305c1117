// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "evaluate/picture/tone.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "simulate/flight/sensor.h"
#include "survey/median.h"

namespace stucco::evaluate {
namespace {

// White stands for a quarter code below it: at its end the curve is level.
constexpr double kWhiteCode = 254.75;
// Beyond this the curve has reached its end.
constexpr double kMostLight = 4;
// Light of the codes 20 and 235 or so: below, a code is a large step and noise lifts the mean;
// above, highlights roll off.
constexpr float kDark = 0.006f;
constexpr float kBright = 0.8f;

double LightOfShare(double share) {
  double low = 0;
  double high = kMostLight;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (simulate::CameraCurve(middle) < share ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

std::array<float, 256> LightOfCodes() {
  std::array<float, 256> light{};
  for (int code = 0; code < 256; ++code) {
    light[code] = static_cast<float>(LightOfShare(std::min<double>(code, kWhiteCode) / 255));
  }
  return light;
}

// Light at which each code begins; with it a code is found without the curve's powers.
std::array<float, 256> StartsOfCodes() {
  std::array<float, 256> starts{};
  for (int code = 1; code < 256; ++code) {
    starts[code] = static_cast<float>(LightOfShare((code - 0.5) / 255));
  }
  return starts;
}

}  // namespace

uint8_t CodeOfLight(double light) {
  static const std::array<float, 256> kStarts = StartsOfCodes();
  const auto next = std::upper_bound(kStarts.begin() + 1, kStarts.end(), light);
  return static_cast<uint8_t>(next - kStarts.begin() - 1);
}

float LightOfCode(uint8_t code) {
  static const std::array<float, 256> kLight = LightOfCodes();
  return kLight[code];
}

Image Developed(std::span<const float> radiance_rgb, ImageSize size,
                const std::array<double, 3>& gains) {
  assert(radiance_rgb.size() == size_t{3} * size.width_px * size.height_px);
  Image image{size.width_px, size.height_px, 3, {}};
  image.data.reserve(radiance_rgb.size());
  for (size_t i = 0; i < radiance_rgb.size(); ++i) {
    image.data.push_back(CodeOfLight(gains[i % 3] * radiance_rgb[i]));
  }
  return image;
}

std::optional<std::array<double, 3>> LogRatios(const float* from_rgb, const float* to_rgb) {
  std::array<double, 3> ratios;
  for (int c = 0; c < 3; ++c) {
    if (!(from_rgb[c] > kDark && to_rgb[c] > kDark && to_rgb[c] < kBright)) return std::nullopt;
    ratios[c] = std::log(to_rgb[c] / from_rgb[c]);
  }
  return ratios;
}

void LightPairs::Add(const float* truth_rgb, const float* result_rgb) {
  const auto ratios = LogRatios(truth_rgb, result_rgb);
  for (int c = 0; ratios && c < 3; ++c) log_ratios[c].push_back((*ratios)[c]);
}

void LightPairs::Append(const LightPairs& other) {
  for (int c = 0; c < 3; ++c) {
    log_ratios[c].insert(log_ratios[c].end(), other.log_ratios[c].begin(),
                         other.log_ratios[c].end());
  }
}

std::array<double, 3> FitGains(LightPairs pairs) {
  std::array<double, 3> gains = {1, 1, 1};
  for (int c = 0; c < 3; ++c) {
    gains[c] = std::exp(Median(std::move(pairs.log_ratios[c])).value_or(0));
  }
  return gains;
}

}  // namespace stucco::evaluate
