// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulate/flight/exposure.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "simulate/random.h"

namespace stucco::simulate {
namespace {

constexpr double kMiddleGrey = 0.19;
constexpr double kBrightest = 0.95;  // of what the sensor can count, for the brightest twentieth
constexpr uint64_t kWhiteSeed = 0x3B17;

// BT.709.
double Luminance(const float* rgb) {
  return 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2];
}

// Three slow waves whose sum stays in [-1, 1].
double SlowWave(double time_s, Random& random) {
  constexpr double kPeriods_s[] = {2700, 1100, 370};
  constexpr double kShares[] = {0.5, 0.3, 0.2};
  double sum = 0;
  for (int i = 0; i < 3; ++i) {
    const double turns = time_s / kPeriods_s[i] + random.Unit();
    sum += kShares[i] * std::sin(2 * std::numbers::pi * turns);
  }
  return sum;
}

}  // namespace

double MeteredExposure(const Radiance& picture) {
  std::vector<double> luminances;
  luminances.reserve(picture.rgb.size() / 3);
  double sum = 0;
  for (size_t i = 0; i + 2 < picture.rgb.size(); i += 3) {
    luminances.push_back(Luminance(&picture.rgb[i]));
    sum += luminances.back();
  }
  if (!(sum > 0)) return 1;  // nothing to see: any exposure will do
  const double mean = sum / static_cast<double>(luminances.size());
  const auto bright = luminances.begin() + static_cast<long>(0.95 * luminances.size());
  std::nth_element(luminances.begin(), bright, luminances.end());
  const double wanted = std::min(kMiddleGrey / mean, kBrightest / std::max(*bright, 1e-6));
  return std::clamp(wanted, 0.01, 100.0);
}

std::vector<double> Exposures(std::span<const double> metered, const FlightOptions& options) {
  if (metered.empty()) return {};
  std::vector<double> sorted(metered.begin(), metered.end());
  std::sort(sorted.begin(), sorted.end());
  const double median = sorted[sorted.size() / 2];
  const double usual = median * std::exp2(options.exposure_ev);
  const double most = std::log1p(options.exposure_drift);
  constexpr double kKept = 0.5;
  std::vector<double> exposures;
  double lagging = std::log(metered[0] / median);
  for (const double wanted : metered) {
    lagging = kKept * lagging + (1 - kKept) * std::log(wanted / median);
    const double kept = most > 0 ? most * std::tanh(lagging / most) : 0;
    exposures.push_back(usual * std::exp(kept));
  }
  return exposures;
}

Eigen::Vector3d WhiteBalance(const Eigen::Vector3d& neutral, double time_s,
                             const FlightOptions& options) {
  Random random(SeedOf(static_cast<uint64_t>(options.seed), kWhiteSeed));
  Eigen::Vector3d gains = neutral;
  gains[0] *= 1 + options.warmth;
  gains[2] *= 1 - options.warmth;
  gains[0] *= 1 + options.white_balance_drift * SlowWave(time_s, random);
  gains[2] *= 1 + options.white_balance_drift * SlowWave(time_s, random);
  return gains;
}

Shutter ShutterFor(double exposure) {
  constexpr double kUnit_s = 1.0 / 1600;
  constexpr double kLongest_s = 1.0 / 200;
  Shutter shutter;
  const double at_iso_100_s = exposure * kUnit_s;
  while (at_iso_100_s * 100 / shutter.iso > kLongest_s && shutter.iso < 6400) shutter.iso *= 2;
  shutter.time_s = at_iso_100_s * 100 / shutter.iso;
  return shutter;
}

}  // namespace stucco::simulate
