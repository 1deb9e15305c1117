// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/dipping/coverage.h"

#include <algorithm>
#include <limits>

namespace stucco::plan {

CoverCounts::CoverCounts(std::vector<double> ends_m) : ends_m_(std::move(ends_m)) {
  std::sort(ends_m_.begin(), ends_m_.end());
  ends_m_.erase(std::unique(ends_m_.begin(), ends_m_.end()), ends_m_.end());
  const size_t pieces = ends_m_.empty() ? 0 : ends_m_.size() - 1;
  added_.assign(4 * pieces, 0);
  least_.assign(4 * pieces, 0);
}

bool CoverCounts::IsCovered(std::span<const Interval> seen, int count) const {
  return std::all_of(seen.begin(), seen.end(), [&](const Interval& interval) {
    return LeastInRange(1, 0, ends_m_.size() - 1, interval) >= count;
  });
}

void CoverCounts::Change(std::span<const Interval> seen, int by) {
  for (const Interval& interval : seen) ChangeRange(1, 0, ends_m_.size() - 1, interval, by);
}

void CoverCounts::ChangeRange(size_t node, size_t begin, size_t end, const Interval& range,
                              int by) {
  if (range.to_m <= ends_m_[begin] || ends_m_[end] <= range.from_m) return;
  if (range.from_m <= ends_m_[begin] && ends_m_[end] <= range.to_m) {
    added_[node] += by;
    least_[node] += by;
    return;
  }
  const size_t middle = (begin + end) / 2;
  ChangeRange(2 * node, begin, middle, range, by);
  ChangeRange(2 * node + 1, middle, end, range, by);
  least_[node] = added_[node] + std::min(least_[2 * node], least_[2 * node + 1]);
}

int CoverCounts::LeastInRange(size_t node, size_t begin, size_t end, const Interval& range) const {
  if (range.to_m <= ends_m_[begin] || ends_m_[end] <= range.from_m) {
    return std::numeric_limits<int>::max() / 2;
  }
  if (range.from_m <= ends_m_[begin] && ends_m_[end] <= range.to_m) return least_[node];
  const size_t middle = (begin + end) / 2;
  return added_[node] + std::min(LeastInRange(2 * node, begin, middle, range),
                                 LeastInRange(2 * node + 1, middle, end, range));
}

}  // namespace stucco::plan
