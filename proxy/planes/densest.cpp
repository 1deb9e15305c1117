// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/planes/densest.h"

#include <algorithm>
#include <cassert>
#include <numeric>
#include <utility>

namespace stucco {

double MeanOfDensest(std::span<const double> ascending, double width) {
  assert(!ascending.empty() && std::ranges::is_sorted(ascending));
  size_t last = 0;
  std::pair<size_t, size_t> most{0, 0};
  for (size_t first = 0; first < ascending.size(); ++first) {
    while (last < ascending.size() && ascending[last] <= ascending[first] + width) ++last;
    if (last - first > most.second - most.first) most = {first, last};
  }
  const auto densest = ascending.subspan(most.first, most.second - most.first);
  return std::accumulate(densest.begin(), densest.end(), 0.0) / static_cast<double>(densest.size());
}

}  // namespace stucco
