// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

namespace stucco {

// IEC 61966-2-1: 8-bit sRGB codes and light, 1 = white.
float LinearFromSrgb(uint8_t code);
double LinearFromSrgb(double share);   // of a code in [0, 1]
double SrgbFromLinear(double linear);  // to a code in [0, 1]; light outside is clamped, NaN is 0
uint8_t SrgbCode(double linear);       // rounded

}  // namespace stucco
