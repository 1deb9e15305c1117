// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/srgb.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace stucco {
namespace {

std::array<float, 256> LinearOfCodes() {
  std::array<float, 256> linear{};
  for (int code = 0; code < 256; ++code) {
    linear[code] = static_cast<float>(LinearFromSrgb(code / 255.0));
  }
  return linear;
}

}  // namespace

float LinearFromSrgb(uint8_t code) {
  static const std::array<float, 256> kLinear = LinearOfCodes();
  return kLinear[code];
}

double LinearFromSrgb(double share) {
  return share <= 0.04045 ? share / 12.92 : std::pow((share + 0.055) / 1.055, 2.4);
}

double SrgbFromLinear(double linear) {
  if (!(linear > 0)) return 0;
  const double light = std::min(linear, 1.0);
  return light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1 / 2.4) - 0.055;
}

uint8_t SrgbCode(double linear) {
  return static_cast<uint8_t>(std::lround(255 * SrgbFromLinear(linear)));
}

}  // namespace stucco
