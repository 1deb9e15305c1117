// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "plan/path/candidates.h"

namespace stucco::plan {

// A closed tour: hovers in order, and which take their photos from the last to the first.
struct Order {
  std::vector<int> hovers;
  std::vector<char> reversed;  // by hover

  Port FirstPort(int hover) const { return 2 * hover + (reversed[hover] != 0 ? 1 : 0); }
  Port LastPort(int hover) const { return 2 * hover + (reversed[hover] != 0 ? 0 : 1); }
};

// Costs between ports with true lengths, remembered in a table of bounded size. For one thread.
class PortCosts {
 public:
  // Keeps a reference to the costs.
  PortCosts(const HoverCosts& costs, std::span<const std::vector<TourCandidate>> candidates);
  double operator()(Port a, Port b);
  // Whether that cost is below the limit; often without looking for a path.
  bool IsBelow(Port a, Port b, double limit);
  // Makes the way between these two so cheap that no search gives it up.
  void Hold(Port a, Port b);

 private:
  struct Entry {
    uint64_t pair = ~uint64_t{0};
    std::array<double, 4> costs{};  // of the ports of both, the lower hover's first
  };
  Entry MakeEntry(int i, int j, double length_m) const;
  static uint64_t Pair(int i, int j);
  Entry& Slot(int i, int j);

  const HoverCosts* costs_;
  std::vector<Entry> table_;
  uint64_t held_ = ~uint64_t{0};  // pair of ports
};

double TourCost(const Order& order, PortCosts& costs);

// The best way to take each hover's photos in a tour of this order (dynamic programming).
void ChooseDirections(Order& order, PortCosts& costs);

}  // namespace stucco::plan
