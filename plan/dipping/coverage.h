// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "survey/intervals.h"

namespace stucco::plan {

// How many views see each part of one facade. The ends of all intervals that will ever be added are
// given at first; adding, removing and asking then cost O(log n) an interval.
class CoverCounts {
 public:
  CoverCounts() = default;
  explicit CoverCounts(std::vector<double> ends_m);

  void Add(std::span<const Interval> seen) { Change(seen, 1); }
  void Remove(std::span<const Interval> seen) { Change(seen, -1); }
  // True when every part of `seen` is in at least `count` of the views.
  bool IsCovered(std::span<const Interval> seen, int count) const;

 private:
  void Change(std::span<const Interval> seen, int by);
  void ChangeRange(size_t node, size_t begin, size_t end, const Interval& range, int by);
  int LeastInRange(size_t node, size_t begin, size_t end, const Interval& range) const;

  std::vector<double> ends_m_;  // sorted
  // A segment tree over the pieces between ends: what was added to a whole node, and the least sum
  // below and in it.
  std::vector<int> added_;
  std::vector<int> least_;
};

}  // namespace stucco::plan
