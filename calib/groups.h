// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

namespace stucco {

// Things tied together, directly or through others (union-find with path halving).
class Groups {
 public:
  explicit Groups(size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0); }

  // The first member of the group.
  int Of(int member) {
    while (parent_[member] != member) member = parent_[member] = parent_[parent_[member]];
    return member;
  }

  // Ties the groups of both together; false where they were one already.
  bool Join(int a, int b) {
    const auto [low, high] = std::minmax({Of(a), Of(b)});
    parent_[high] = low;
    return low != high;
  }

 private:
  std::vector<int> parent_;
};

}  // namespace stucco
