// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

namespace stucco::simulate::internal {

// Linear light, 0 to 1: colours are mixed, averaged and shaded as light is.
struct Colour {
  float r = 0;
  float g = 0;
  float b = 0;
};

inline Colour operator+(Colour a, Colour b) {
  return {a.r + b.r, a.g + b.g, a.b + b.b};
}
inline Colour operator-(Colour a, Colour b) {
  return {a.r - b.r, a.g - b.g, a.b - b.b};
}
inline Colour operator*(Colour a, Colour b) {
  return {a.r * b.r, a.g * b.g, a.b * b.b};
}
inline Colour operator*(Colour a, float s) {
  return {a.r * s, a.g * s, a.b * s};
}
inline Colour operator*(float s, Colour a) {
  return a * s;
}
inline Colour Mix(Colour a, Colour b, float share) {
  return a + (b - a) * share;
}
inline Colour Grey(float value) {
  return {value, value, value};
}
// Rec. 709
inline float Luminance(Colour c) {
  return 0.2126f * c.r + 0.7152f * c.g + 0.0722f * c.b;
}

// A little brighter or darker: a relative change that keeps colours positive, 1 + x near 0.
inline float Tone(float x) {
  return x >= 0 ? 1 + x : 1 / (1 - x);
}

// As SrgbCode of survey/srgb.h, from a table.
uint8_t FastSrgbCode(float linear);
// A colour as one reads it off a screen.
Colour FromSrgb(uint8_t r, uint8_t g, uint8_t b);

}  // namespace stucco::simulate::internal
