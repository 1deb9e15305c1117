// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace stucco::plan {

// Notes what was wrong with a map and how it was mended.
class RepairLog {
 public:
  // `building` may be empty: then it is about the map as a whole.
  void Add(std::string building, std::string what) {
    entries_.emplace_back(std::move(building), std::move(what));
  }
  void Add(const RepairLog& other) {
    entries_.insert(entries_.end(), other.entries_.begin(), other.entries_.end());
  }

  // "B0012: contour crosses itself; repaired", in the order in which they were noted. Where more
  // than 20 buildings share a repair, one line counts them and names the first.
  std::vector<std::string> Lines() const;

 private:
  std::vector<std::pair<std::string, std::string>> entries_;
};

}  // namespace stucco::plan
