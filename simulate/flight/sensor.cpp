// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulate/flight/sensor.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "simulate/flight/blur.h"
#include "simulate/flight/sharpen.h"
#include "simulate/random.h"
#include "survey/parallel.h"
#include "survey/srgb.h"

namespace stucco::simulate {
namespace {

constexpr double kReadShare = 0.25;

// Nearly normal, variance 1: the sum of the four 16-bit numbers in a scrambled counter. Ten times
// faster than logarithms, and with the tails cut at 3.5 standard deviations.
float NoiseAt(uint64_t seed, uint64_t index) {
  const uint64_t bits = Scrambled(seed + index * 0x9E3779B97F4A7C15u);
  const auto sum = static_cast<float>((bits & 0xFFFF) + (bits >> 16 & 0xFFFF) +
                                      (bits >> 32 & 0xFFFF) + (bits >> 48));
  constexpr float kMean = 2 * 65535.0f;
  constexpr float kScale = 1.7320508f / 65536;  // each has a variance of 1/12
  return (sum - kMean) * kScale;
}

// CameraCurve from a table, times 255.
class CurveTable {
 public:
  CurveTable() : values_(kSteps + 2) {
    for (size_t i = 0; i < values_.size(); ++i) {
      const double root = static_cast<double>(i) / kSteps;
      values_[i] = static_cast<float>(255 * CameraCurve(kMost * root * root));
    }
  }

  uint8_t At(float linear) const {
    // Evenly spaced in the square root, where the curve is nearly straight.
    const float at = std::sqrt(std::clamp(linear / kMost, 0.0f, 1.0f)) * kSteps;
    const auto left = static_cast<size_t>(at);
    const float value =
        values_[left] + (at - static_cast<float>(left)) * (values_[left + 1] - values_[left]);
    return static_cast<uint8_t>(std::clamp(value + 0.5f, 0.0f, 255.0f));
  }

 private:
  static constexpr int kSteps = 4096;
  static constexpr float kMost = 4;
  std::vector<float> values_;
};

void DevelopRow(const Radiance& picture, const Camera& camera, const SensorEffects& effects, int y,
                Image& image) {
  static const CurveTable curve;
  const Eigen::Array3f balance = effects.white_balance.cast<float>();
  const auto noise2 = static_cast<float>(effects.noise * effects.noise);
  constexpr auto kRead2 = static_cast<float>(kReadShare * kReadShare);
  for (int x = 0; x < picture.width_px; ++x) {
    const size_t index = static_cast<size_t>(y) * picture.width_px + x;
    const auto gain = static_cast<float>(
        effects.exposure * Vignetting(camera, effects.vignetting, {x + 0.5, y + 0.5}));
    for (int c = 0; c < 3; ++c) {
      float light = gain * picture.rgb[3 * index + c];
      if (noise2 > 0) {
        const float variance = noise2 * ((1 - kRead2) * std::max(light, 0.0f) + kRead2);
        light += std::sqrt(variance) * NoiseAt(effects.seed, 3 * index + c);
      }
      image.data[3 * index + c] = curve.At(light * balance[c]);
    }
  }
}

}  // namespace

double Vignetting(const Camera& camera, double lost, const Eigen::Vector2d& pixel) {
  const Eigen::Vector2d centre = camera.PrincipalPoint();
  const Eigen::Vector2d corner(std::max(centre.x(), camera.width_px - centre.x()),
                               std::max(centre.y(), camera.height_px - centre.y()));
  return 1 - lost * (pixel - centre).squaredNorm() / corner.squaredNorm();
}

double CameraCurve(double linear) {
  constexpr double kShoulder = 0.7;
  constexpr double kContrast = 0.2;
  double value = std::max(0.0, linear);
  if (value > kShoulder) {
    const double room = 1 - kShoulder;
    value = kShoulder + room * (1 - std::exp(-(value - kShoulder) / room));
  }
  const double coded = SrgbFromLinear(value);
  return coded + kContrast * coded * (1 - coded) * (2 * coded - 1);
}

Image Develop(Radiance picture, const Camera& camera, const SensorEffects& effects, int threads) {
  BlurByFocus(effects.focus_blur_px, threads, picture);
  BlurByTurning(camera, effects.turn_rad, threads, picture);
  Image image{picture.width_px, picture.height_px, 3, {}};
  image.data.resize(picture.rgb.size());
  ParallelFor(static_cast<size_t>(picture.height_px), threads,
              [&](size_t y) { DevelopRow(picture, camera, effects, static_cast<int>(y), image); });
  return Sharpened(std::move(image), effects.sharpening, threads);
}

}  // namespace stucco::simulate
