// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/relief/stretch.h"

#include <algorithm>
#include <iterator>
#include <numeric>
#include <vector>

namespace stucco {
namespace {

constexpr int kLeastGap = 3;
constexpr double kSilent = 0.1;  // of the mean

struct Speaking {
  int begin = 0;
  int end = 0;
  double sum = 0;
};

std::vector<Speaking> SpeakingRunsOf(std::span<const double> speaks) {
  const double total = std::accumulate(speaks.begin(), speaks.end(), 0.0);
  const double silent = kSilent * total / static_cast<double>(speaks.size());
  std::vector<Speaking> runs;
  for (int i = 0; i < std::ssize(speaks); ++i) {
    if (speaks[i] <= silent) continue;
    if (runs.empty() || i - runs.back().end >= kLeastGap) runs.push_back({i, i, 0});
    runs.back().end = i + 1;
    runs.back().sum += speaks[i];
  }
  return runs;
}

}  // namespace

Stretch LargestStretch(std::span<const double> speaks) {
  const int count = static_cast<int>(speaks.size());
  const std::vector<Speaking> runs = SpeakingRunsOf(speaks);
  if (runs.empty()) return {0, count, 0, count};
  const auto largest = std::ranges::max_element(runs, {}, &Speaking::sum);
  return {.begin = largest->begin,
          .end = largest->end,
          .low = largest == runs.begin() ? 0 : std::prev(largest)->end,
          .high = std::next(largest) == runs.end() ? count : std::next(largest)->begin};
}

}  // namespace stucco
