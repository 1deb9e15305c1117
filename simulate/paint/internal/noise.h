// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "simulate/floor.h"

namespace stucco::simulate::internal {

// A well mixed 32-bit word of three. Wherever a number is drawn, it is drawn from the integer
// coordinates of what it is for, so that no picture depends on the order of painting.
inline uint32_t Hash(uint32_t a, uint32_t b, uint32_t seed) {
  uint32_t h = (a * 0x9e3779b1u) ^ (b * 0x85ebca77u + 0x7f4a7c15u) ^ (seed * 0xc2b2ae3du);
  h = (h ^ (h >> 15)) * 0x2c1b3c6du;
  h = (h ^ (h >> 12)) * 0x297a2d39u;
  return h ^ (h >> 15);
}

inline uint32_t Hash(uint64_t a, uint32_t seed) {
  return Hash(static_cast<uint32_t>(a), static_cast<uint32_t>(a >> 32), seed);
}

// [0, 1)
inline float ToUnit(uint32_t bits) {
  return static_cast<float>(bits >> 8) * 0x1p-24f;
}

inline float Uniform(int a, int b, uint32_t seed) {
  return ToUnit(Hash(static_cast<uint32_t>(a), static_cast<uint32_t>(b), seed));
}

// Mean 0, standard deviation 1, within +-3.46: the sum of four bytes, which is close to normal.
inline float Normal(int a, int b, uint32_t seed) {
  const uint32_t h = Hash(static_cast<uint32_t>(a), static_cast<uint32_t>(b), seed);
  const int sum = (h & 255) + ((h >> 8) & 255) + ((h >> 16) & 255) + (h >> 24);
  return static_cast<float>(sum - 510) * (1.0f / 147.8f);
}

inline float Smooth(float low, float high, float value) {
  const float t = std::clamp((value - low) / (high - low), 0.0f, 1.0f);
  return t * t * (3 - 2 * t);
}

inline float Mix(float a, float b, float share) {
  return a + (b - a) * share;
}

// Gradient noise of wavelength 1 (Perlin, "Improving noise", 2002), scaled to a standard deviation
// of 1.
inline float GradientNoise(float x, float y, uint32_t seed) {
  const int xi = Floor(x);
  const int yi = Floor(y);
  const float u = x - static_cast<float>(xi);
  const float v = y - static_cast<float>(yi);
  const auto corner = [seed](int cx, int cy, float dx, float dy) {
    const uint32_t h = Hash(static_cast<uint32_t>(cx), static_cast<uint32_t>(cy), seed);
    // Any gradient will do whose directions are even: two 16-bit numbers around zero.
    return (static_cast<float>(h & 0xffff) - 32767.5f) * dx +
           (static_cast<float>(h >> 16) - 32767.5f) * dy;
  };
  const float fu = u * u * u * (u * (u * 6 - 15) + 10);
  const float fv = v * v * v * (v * (v * 6 - 15) + 10);
  const float top = Mix(corner(xi, yi, u, v), corner(xi + 1, yi, u - 1, v), fu);
  const float bottom = Mix(corner(xi, yi + 1, u, v - 1), corner(xi + 1, yi + 1, u - 1, v - 1), fu);
  return Mix(top, bottom, fv) * (5.2f / 32768);
}

// How much of a wave is left when its picture has texels of `texel_m`: all of it from four texels
// a wave, nothing below two.
inline float BandShare(float wavelength_m, float texel_m) {
  return std::clamp(wavelength_m / (2 * texel_m) - 1, 0.0f, 1.0f);
}

// Octaves of gradient noise from `wavelength_m` downwards, each half the wave and `gain` times the
// height of the one before, up to what texels of `texel_m` can show.
struct Octaves {
  float wavelength_m = 1;
  int count = 4;
  float gain = 0.5f;
  uint32_t seed = 0;
};

inline float Noise(float x, float y, const Octaves& octaves, float texel_m) {
  float sum = 0;
  float height = 1;
  float wavelength = octaves.wavelength_m;
  for (int i = 0; i < octaves.count; ++i) {
    const float share = BandShare(wavelength, texel_m);
    if (share <= 0) break;
    sum += share * height * GradientNoise(x / wavelength, y / wavelength, octaves.seed + i * 101);
    height *= octaves.gain;
    wavelength *= 0.5f;
  }
  return sum;
}

}  // namespace stucco::simulate::internal
