// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

namespace stucco {

// Median of the absolute value of a normal variable, in its standard deviations.
inline constexpr double kMedianOfNormal = 0.6745;

// The middle value, of an even number the upper of the two; nothing of none.
inline std::optional<double> Median(std::vector<double> values) {
  if (values.empty()) return std::nullopt;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// The value below or at which a share of the values lies (nearest rank); nothing of none. Requires
// a share in [0, 1].
inline std::optional<double> Quantile(std::vector<double> values, double share) {
  assert(share >= 0 && share <= 1);
  if (values.empty()) return std::nullopt;
  const double rank = std::ceil(share * static_cast<double>(values.size()));
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(std::max(rank, 1.0)) - 1;
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

}  // namespace stucco
