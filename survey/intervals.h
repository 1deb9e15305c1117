// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>
#include <vector>

namespace stucco {

// From..to in metres along something; to >= from.
struct Interval {
  double from_m = 0;
  double to_m = 0;
  double length_m() const { return to_m - from_m; }
  bool operator==(const Interval&) const = default;
};

// A set of points on a line: disjoint intervals in ascending order, none empty.
using Intervals = std::vector<Interval>;

// The common part; nothing when it is empty or a single point.
std::optional<Interval> Intersection(const Interval& a, const Interval& b);
Intervals Intersection(std::span<const Interval> set, const Interval& window);
Intervals Intersection(std::span<const Interval> a, std::span<const Interval> b);
// Any intervals to a set: sorted, touching ones joined, empty ones dropped.
Intervals Union(Intervals intervals);
// What of `window` the set leaves uncovered.
Intervals Gaps(std::span<const Interval> set, const Interval& window);
Intervals Difference(std::span<const Interval> a, std::span<const Interval> b);
double Length(std::span<const Interval> set);

}  // namespace stucco
