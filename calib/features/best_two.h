// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "calib/features/match.h"

namespace stucco {

// Angle between descriptors with this product, as UnitDescriptors scales them.
double DescriptorAngle(int32_t product);

// The largest and second largest product of a descriptor with others seen so far.
struct BestTwo {
  int32_t best = -1;
  int32_t second = -1;
  int32_t index = -1;  // of the descriptor that gave the largest

  void Offer(int32_t product, int32_t candidate) {
    if (product > best) {
      second = std::max(second, best);
      best = product;
      index = candidate;
    } else if (product > second) {
      second = product;
    }
  }
  // What is no candidate itself, but would be as likely if it is as similar.
  void Rival(int32_t product) { second = std::max(second, product); }

  // Lowe's test on the angles between the descriptors.
  bool PassesRatio(double ratio) const;
};

// Pairs that are each other's best and pass the ratio test both ways; by the first.
std::vector<Match> MutualMatches(const std::vector<BestTwo>& of_first,
                                 const std::vector<BestTwo>& of_second, double ratio);

}  // namespace stucco
