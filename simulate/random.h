// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace stucco::simulate {

// The finaliser of SplitMix64: every bit of the result depends on every bit of `x`.
constexpr uint64_t Scrambled(uint64_t x) {
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

// A seed for unit `b` of the work that has seed `a`.
constexpr uint64_t SeedOf(uint64_t a, uint64_t b) {
  return Scrambled(Scrambled(a + 0x9e3779b97f4a7c15u) + b * 0xd1342543de82ef95u);
}

// Random numbers whose bytes depend on the seed alone, unlike those of the standard library's
// distributions: SplitMix64 (Steele, Lea, Flood: "Fast splittable pseudorandom number generators",
// 2014).
class Random {
 public:
  explicit Random(uint64_t seed) : state_(seed) {}
  // A stream of its own for part `index` of what `seed` makes: what one part draws does not change
  // the others.
  Random(uint64_t seed, uint64_t index) : state_(seed) {
    state_ = Next() ^ (index * 0x9e3779b97f4a7c15u);
    Next();
  }

  uint64_t Next() { return Scrambled(state_ += 0x9e3779b97f4a7c15u); }
  // In [0, 1).
  double Unit() { return static_cast<double>(Next() >> 11) * 0x1p-53; }
  double Uniform(double from, double to) { return from + (to - from) * Unit(); }
  // In [0, count). Requires count > 0. The modulo favours small numbers by less than count / 2^64.
  int Index(int count) {
    assert(count > 0);
    return static_cast<int>(Next() % static_cast<uint64_t>(count));
  }
  int Integer(int from, int to) { return from + Index(to - from + 1); }  // both inclusive
  bool Chance(double probability) { return Unit() < probability; }
  // Standard normal (Box and Muller, 1958).
  double Normal() {
    const double radius = std::sqrt(-2 * std::log(1 - Unit()));
    return radius * std::cos(2 * std::numbers::pi * Unit());
  }
  Eigen::Vector3d NormalVector() {
    const double x = Normal();
    const double y = Normal();
    return {x, y, Normal()};
  }

 private:
  uint64_t state_;
};

}  // namespace stucco::simulate
