// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/features/best_two.h"

#include <algorithm>
#include <cmath>

#include "calib/features/descriptors.h"

namespace stucco {

double DescriptorAngle(int32_t product) {
  return std::acos(std::clamp(product / (kDescriptorUnit * kDescriptorUnit), -1.0, 1.0));
}

bool BestTwo::PassesRatio(double ratio) const {
  return index >= 0 && DescriptorAngle(best) < ratio * DescriptorAngle(second);
}

std::vector<Match> MutualMatches(const std::vector<BestTwo>& of_first,
                                 const std::vector<BestTwo>& of_second, double ratio) {
  std::vector<Match> matches;
  for (size_t i = 0; i < of_first.size(); ++i) {
    const int j = of_first[i].index;
    if (j < 0 || of_second[j].index != static_cast<int>(i)) continue;
    if (of_first[i].PassesRatio(ratio) && of_second[j].PassesRatio(ratio)) {
      matches.push_back({static_cast<int32_t>(i), j});
    }
  }
  return matches;
}

}  // namespace stucco
