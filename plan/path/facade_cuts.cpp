// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/path/facade_cuts.h"

namespace stucco::plan {
namespace {

// The hovers of each facade in the tour's order.
std::vector<std::vector<int>> HoversOfFacades(std::span<const Hover> tour, size_t facades) {
  std::vector<std::vector<int>> hovers(facades);
  for (size_t k = 0; k < tour.size(); ++k) {
    for (const Shot& shot : tour[k].shots) {
      for (const Target& target : shot.targets) {
        std::vector<int>& of = hovers[target.facade];
        if (of.empty() || of.back() != static_cast<int>(k)) of.push_back(static_cast<int>(k));
      }
    }
  }
  return hovers;
}

// Where in `hovers` the longest stretch to the next of them begins.
size_t LongestGap(const std::vector<int>& hovers, int tour_size) {
  size_t longest = hovers.size() - 1;
  int length = hovers.front() + tour_size - hovers.back();
  for (size_t i = 0; i + 1 < hovers.size(); ++i) {
    if (hovers[i + 1] - hovers[i] <= length) continue;
    length = hovers[i + 1] - hovers[i];
    longest = i;
  }
  return longest;
}

}  // namespace

std::vector<int> FacadesDivided(std::span<const Hover> tour, size_t facades) {
  const int n = static_cast<int>(tour.size());
  std::vector<int> change(n + 1, 0);
  for (const std::vector<int>& hovers : HoversOfFacades(tour, facades)) {
    if (hovers.size() < 2) continue;
    const size_t gap = LongestGap(hovers, n);
    const int from = hovers[(gap + 1) % hovers.size()];
    const int to = hovers[gap];
    ++change[from];
    --change[to];
    if (to < from) ++change[0];  // it goes on over the tour's end
  }
  std::vector<int> divided(n);
  for (int k = 0, sum = 0; k < n; ++k) divided[k] = sum += change[k];
  return divided;
}

}  // namespace stucco::plan
