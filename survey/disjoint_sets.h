// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <limits>
#include <numeric>
#include <vector>

namespace stucco {

// Things 0 ... count - 1 tied together, directly or through others (union-find with path halving:
// Tarjan and van Leeuwen, "Worst-case analysis of set union algorithms", 1984). Sets are not
// balanced by size, so that a set goes by its smallest member in whatever order it came about.
class DisjointSets {
 public:
  // Requires that an int can number them.
  explicit DisjointSets(size_t count) : parent_(count) {
    assert(count <= static_cast<size_t>(std::numeric_limits<int>::max()));
    std::iota(parent_.begin(), parent_.end(), 0);
  }

  size_t size() const { return parent_.size(); }

  // The smallest member of the set that `member` is in. Requires 0 <= member < size().
  int Find(int member) {
    assert(member >= 0 && static_cast<size_t>(member) < parent_.size());
    while (parent_[member] != member) member = parent_[member] = parent_[parent_[member]];
    return member;
  }

  // Makes one set of those that both are in; false where they were one already.
  bool Join(int a, int b) {
    const auto [low, high] = std::minmax({Find(a), Find(b)});
    parent_[high] = low;
    return low != high;
  }

 private:
  std::vector<int> parent_;
};

}  // namespace stucco
