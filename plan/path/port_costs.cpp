// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/path/port_costs.h"

#include <algorithm>
#include <array>
#include <bit>
#include <limits>

namespace stucco::plan {
namespace {

// Per hover; a search asks for fewer different neighbours.
constexpr size_t kEntriesPerHover = 256;
constexpr size_t kMostEntries = size_t{1} << 22;  // 168 MB

// Of an edge that is held: a gain that no way makes up for.
constexpr double kHeld = -1e7;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

}  // namespace

PortCosts::PortCosts(const HoverCosts& costs,
                     std::span<const std::vector<TourCandidate>> candidates)
    : costs_(&costs),
      table_(std::min(std::bit_ceil(kEntriesPerHover * candidates.size() + 1), kMostEntries)) {
  for (size_t i = 0; i < candidates.size(); ++i) {
    for (const TourCandidate& candidate : candidates[i]) {
      const int from = static_cast<int>(i);
      Slot(from, candidate.hover) = MakeEntry(from, candidate.hover, candidate.length_m);
    }
  }
}

uint64_t PortCosts::Pair(int i, int j) {
  const auto [low, high] = std::minmax(i, j);
  return static_cast<uint64_t>(low) << 32 | static_cast<uint64_t>(high);
}

PortCosts::Entry& PortCosts::Slot(int i, int j) {
  // Fibonacci hashing; the table's size is a power of two.
  const uint64_t hash = (Pair(i, j) * 0x9E3779B97F4A7C15u) >> 20;
  return table_[hash & (table_.size() - 1)];
}

PortCosts::Entry PortCosts::MakeEntry(int i, int j, double length_m) const {
  const auto [low, high] = std::minmax(i, j);
  const double weight = costs_->Weight(low, high);
  Entry entry{Pair(low, high), {}};
  for (int k = 0; k < 4; ++k) {
    const double turn = costs_->Turn(2 * low + k / 2, 2 * high + k % 2);
    entry.costs[k] = HoverCosts::Cost(weight, length_m, turn);
  }
  return entry;
}

void PortCosts::Hold(Port a, Port b) {
  held_ = Pair(a, b);
}

double PortCosts::operator()(Port a, Port b) {
  if (a > b) std::swap(a, b);
  if (Pair(a, b) == held_) return kHeld;
  const int i = a / 2;
  const int j = b / 2;
  if (i == j) return 0;
  Entry& entry = Slot(i, j);
  if (entry.pair != Pair(i, j)) entry = MakeEntry(i, j, costs_->Length(i, j));
  return entry.costs[2 * (a & 1) + (b & 1)];
}

bool PortCosts::IsBelow(Port a, Port b, double limit) {
  if (Pair(a, b) == held_) return kHeld < limit;
  if (limit <= 0) return false;
  const int i = a / 2;
  const int j = b / 2;
  if (Slot(i, j).pair != Pair(i, j)) {
    // A bound first: most ask for hovers much too far away.
    if (kLeastWeight * costs_->Straight(i, j) >= limit || costs_->LeastCost(i, j) >= limit) {
      return false;
    }
  }
  return (*this)(a, b) < limit;
}

double TourCost(const Order& order, PortCosts& costs) {
  double sum = 0;
  for (size_t k = 0; k < order.hovers.size(); ++k) {
    const int from = order.hovers[k];
    const int to = order.hovers[(k + 1) % order.hovers.size()];
    sum += costs(order.LastPort(from), order.FirstPort(to));
  }
  return sum;
}

namespace {

// The cheapest ways on from hover `from`, taken either way for `sum`, to either direction of `to`;
// and which direction of `from` each comes by.
struct DirectionStep {
  std::array<double, 2> sum{kInfinity, kInfinity};
  std::array<char, 2> before{};
};
DirectionStep StepOn(const std::array<double, 2>& sum, int from, int to, PortCosts& costs) {
  DirectionStep step;
  for (const int out : {0, 1}) {
    for (const int in : {0, 1}) {
      const double through = sum[out] + costs(2 * from + 1 - out, 2 * to + in);
      if (!(through < step.sum[in])) continue;
      step.sum[in] = through;
      step.before[in] = static_cast<char>(out);
    }
  }
  return step;
}

}  // namespace

// Shortest path through the graph of the hovers' two directions, once for either direction of the
// first hover.
void ChooseDirections(Order& order, PortCosts& costs) {
  const size_t n = order.hovers.size();
  if (n < 2) return;
  double best = kInfinity;
  std::vector<char> best_reversed = order.reversed;
  std::vector<std::array<char, 2>> before(n);
  for (const int first : {0, 1}) {
    std::array<double, 2> sum{first == 0 ? 0 : kInfinity, first == 1 ? 0 : kInfinity};
    for (size_t k = 1; k <= n; ++k) {
      const DirectionStep step = StepOn(sum, order.hovers[k - 1], order.hovers[k % n], costs);
      sum = step.sum;
      before[k % n] = step.before;
    }
    if (!(sum[first] < best)) continue;
    best = sum[first];
    char state = static_cast<char>(first);
    for (size_t k = n; k > 0; --k) {
      state = before[k % n][static_cast<size_t>(state)];
      best_reversed[order.hovers[k - 1]] = state;
    }
  }
  order.reversed = best_reversed;
}

}  // namespace stucco::plan
