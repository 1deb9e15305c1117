// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/intervals.h"

#include <algorithm>

namespace stucco {

std::optional<Interval> Intersection(const Interval& a, const Interval& b) {
  const Interval common{std::max(a.from_m, b.from_m), std::min(a.to_m, b.to_m)};
  if (common.from_m < common.to_m) return common;
  return std::nullopt;
}

Intervals Intersection(std::span<const Interval> set, const Interval& window) {
  Intervals result;
  for (const Interval& interval : set) {
    if (const auto common = Intersection(interval, window)) result.push_back(*common);
  }
  return result;
}

Intervals Intersection(std::span<const Interval> a, std::span<const Interval> b) {
  Intervals result;
  size_t i = 0, j = 0;
  while (i < a.size() && j < b.size()) {
    if (const auto common = Intersection(a[i], b[j])) result.push_back(*common);
    if (a[i].to_m < b[j].to_m) {
      ++i;
    } else {
      ++j;
    }
  }
  return result;
}

Intervals Union(Intervals intervals) {
  std::sort(intervals.begin(), intervals.end(), [](const Interval& a, const Interval& b) {
    return a.from_m != b.from_m ? a.from_m < b.from_m : a.to_m < b.to_m;
  });
  Intervals result;
  for (const Interval& interval : intervals) {
    if (!(interval.from_m < interval.to_m)) continue;
    if (!result.empty() && interval.from_m <= result.back().to_m) {
      result.back().to_m = std::max(result.back().to_m, interval.to_m);
    } else {
      result.push_back(interval);
    }
  }
  return result;
}

Intervals Gaps(std::span<const Interval> set, const Interval& window) {
  Intervals result;
  double begin = window.from_m;
  for (const Interval& interval : set) {
    if (interval.to_m <= begin) continue;
    if (interval.from_m >= window.to_m) break;
    if (begin < interval.from_m) result.push_back({begin, interval.from_m});
    begin = interval.to_m;
  }
  if (begin < window.to_m) result.push_back({begin, window.to_m});
  return result;
}

Intervals Difference(std::span<const Interval> a, std::span<const Interval> b) {
  Intervals result;
  for (const Interval& interval : a) {
    const Intervals gaps = Gaps(b, interval);
    result.insert(result.end(), gaps.begin(), gaps.end());
  }
  return result;
}

double Length(std::span<const Interval> set) {
  double length = 0;
  for (const Interval& interval : set) length += interval.length_m();
  return length;
}

}  // namespace stucco
