// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <cstdint>

namespace stucco::simulate::internal {

// The finaliser of SplitMix64 (Steele, Lea, Flood, "Fast splittable pseudorandom number
// generators", 2014): every bit of the result depends on every bit of `x`.
constexpr uint64_t Scrambled(uint64_t x) {
  x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9u;
  x = (x ^ (x >> 27)) * 0x94D049BB133111EBu;
  return x ^ (x >> 31);
}

// A seed for unit `b` of the work that has seed `a`.
constexpr uint64_t SeedOf(uint64_t a, uint64_t b) {
  return Scrambled(Scrambled(a + 0x9E3779B97F4A7C15u) + b * 0xD1342543DE82EF95u);
}

// SplitMix64. Unlike the distributions of the standard library its numbers are the same everywhere.
class Random {
 public:
  explicit Random(uint64_t seed) : state_(seed) {}

  uint64_t Next() { return Scrambled(state_ += 0x9E3779B97F4A7C15u); }
  double Uniform() { return static_cast<double>(Next() >> 11) * 0x1.0p-53; }  // [0, 1)
  double Uniform(double from, double to) { return from + (to - from) * Uniform(); }
  // Standard normal (Box and Muller 1958).
  double Normal() {
    const double radius = std::sqrt(-2 * std::log(1 - Uniform()));
    return radius * std::cos(6.28318530717958647692 * Uniform());
  }

 private:
  uint64_t state_;
};

}  // namespace stucco::simulate::internal
