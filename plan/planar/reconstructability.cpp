// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/planar/reconstructability.h"

#include <cmath>
#include <numbers>

namespace stucco::plan {
namespace {

// Slopes and centres of the two logistic weights (Smith et al. 2018).
constexpr double kParallaxSlope = 32;
constexpr double kParallaxAngle = std::numbers::pi / 16;
constexpr double kMatchSlope = 8;
constexpr double kMatchAngle = std::numbers::pi / 4;
constexpr double kGoodIncidence = 8.66 * std::numbers::pi / 180;  // of both rays of a good pair

}  // namespace

double ParallaxWeight(double angle_rad) {
  return 1 / (1 + std::exp(-kParallaxSlope * (angle_rad - kParallaxAngle)));
}

double MatchWeight(double angle_rad) {
  return 1 - 1 / (1 + std::exp(-kMatchSlope * (angle_rad - kMatchAngle)));
}

double GoodPair(double distance_m, double d_max_m) {
  return ParallaxWeight(2 * kGoodIncidence) * ResolutionWeight(distance_m, d_max_m) *
         MatchWeight(2 * kGoodIncidence) * std::cos(kGoodIncidence);
}

}  // namespace stucco::plan
