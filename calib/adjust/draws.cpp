// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/adjust/internal/draws.h"

namespace stucco {
namespace {

// splitmix64 (Steele et al. 2014).
uint64_t Mix(uint64_t state) {
  uint64_t z = state;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
  z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
  return z ^ (z >> 31);
}

}  // namespace

Draws::Signs Draws::SignsOf(uint64_t key) {
  constexpr uint64_t kStep = 0x9e3779b97f4a7c15;
  constexpr int kBits = 64;
  Signs signs;
  uint64_t state = Mix(key + kStep);
  for (int begin = 0; begin < kCount; begin += kBits) {
    state += kStep;
    const uint64_t bits = Mix(state);
    for (int i = 0; i < kBits; ++i) signs[begin + i] = (bits >> i & 1) != 0 ? 1 : -1;
  }
  return signs;
}

}  // namespace stucco
