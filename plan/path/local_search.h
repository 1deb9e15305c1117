// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <random>
#include <span>
#include <vector>

#include "plan/path/port_costs.h"

namespace stucco::plan {

// Local search on a tour: Lin-Kernighan chains of reversals (Lin and Kernighan, "An effective
// heuristic algorithm for the traveling-salesman problem", 1973), moves of up to three hovers
// (Or-opt), turning single hovers; then swaps of neighbouring stretches that are taken back unless
// local search makes them pay. Moves start from hovers whose surroundings changed. Reversing a
// stretch reverses the photos of its hovers too, which is why it costs nothing but its ends.
class TourSearch {
 public:
  // At least eight hovers. Keeps references to costs and candidates.
  TourSearch(PortCosts& costs, std::span<const std::vector<TourCandidate>> candidates,
             const Order& start);

  // To a local optimum.
  void Improve();
  // `count` swaps around places that `random` picks.
  void Perturb(int count, std::mt19937_64& random);

  Order Result() const { return {order_, reversed_}; }

 private:
  struct Change {
    int from = 0;
    int to = 0;
  };
  struct Step {
    int to = 0;    // gets the new edge from the open end
    int over = 0;  // loses its edge to `to` and becomes the open end
    double gain = 0;
  };

  int Next(int hover) const { return order_[Wrapped(place_[hover] + 1)]; }
  int Previous(int hover) const { return order_[Wrapped(place_[hover] - 1)]; }
  int Wrapped(int place) const {
    return place < 0 ? place + size_ : place >= size_ ? place - size_ : place;
  }
  // The port towards the next (forward) or the previous hover.
  Port Facing(int hover, bool forward) const {
    return 2 * hover + (forward != static_cast<bool>(reversed_[hover]) ? 1 : 0);
  }
  double EdgeCost(int hover, int next) { return costs_(Facing(hover, true), Facing(next, false)); }

  void Reverse(int from, int to);
  void Exchange(int a, int b, int c, int d);
  int ReversalLength(int from, int to) const;
  void TakeBack(size_t mark);
  void Wake(int hover);
  double ImproveAwake();
  double ImproveAt(int hover);
  double Chain(int first, bool forward);
  bool Extend(int depth, int first, int last, double gain, double& best);
  std::vector<Step> LookAhead(int first, int last, double gain, size_t breadth);
  double MoveStretch(int hover, bool forward);
  double TurnOne(int hover);
  double SwapStretches(std::mt19937_64& random);

  PortCosts& costs_;
  std::span<const std::vector<TourCandidate>> candidates_;
  int size_ = 0;
  std::vector<int> order_;
  std::vector<int> place_;
  std::vector<char> reversed_;
  std::vector<Change> log_;
  std::vector<int> awake_;
  std::vector<char> is_awake_;
};

}  // namespace stucco::plan
