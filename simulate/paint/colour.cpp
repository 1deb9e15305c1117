// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulate/paint/internal/colour.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "survey/srgb.h"

namespace stucco::simulate::internal {
namespace {

constexpr int kSteps = 1 << 13;  // in square roots of light: finer than an 8-bit code everywhere

std::array<uint8_t, kSteps + 1> CodesOfRoots() {
  std::array<uint8_t, kSteps + 1> codes;
  for (int i = 0; i <= kSteps; ++i) {
    const double root = static_cast<double>(i) / kSteps;
    codes[i] = SrgbCode(root * root);
  }
  return codes;
}

}  // namespace

uint8_t FastSrgbCode(float linear) {
  static const std::array<uint8_t, kSteps + 1> kCodes = CodesOfRoots();
  // Written so that NaN is black.
  const float light = linear > 0 ? std::min(linear, 1.0f) : 0.0f;
  // Never negative. NOLINTNEXTLINE(bugprone-incorrect-roundings)
  return kCodes[static_cast<int>(std::sqrt(light) * kSteps + 0.5f)];
}

Colour FromSrgb(uint8_t r, uint8_t g, uint8_t b) {
  return {LinearFromSrgb(r), LinearFromSrgb(g), LinearFromSrgb(b)};
}

}  // namespace stucco::simulate::internal
