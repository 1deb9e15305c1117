// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/path/local_search.h"

#include <algorithm>
#include <array>
#include <cstdlib>

namespace stucco::plan {
namespace {

constexpr double kLeastGain = 1e-7;
// Alternatives tried at each depth of a chain; one beyond.
constexpr std::array<size_t, 2> kBreadth{4, 2};
constexpr int kDeepest = 6;
constexpr int kLongestStretch = 3;
// Perturbation swaps stretches of up to this many hovers.
constexpr int kLongestSwap = 30;
// Longer reversals are made only if they pay at once, not to see what may follow: trials must not
// cost more on bigger tours.
constexpr int kLongestTrial = 1000;

}  // namespace

// A reversal between two places is its own inverse, which makes taking back exact. The other part
// of the circle is reversed instead where it is shorter: the same tour, read backwards.
void TourSearch::Reverse(int from, int to) {
  int count = Wrapped(to - from) + 1;
  if (2 * count > size_) {
    const int other = Wrapped(to + 1);
    to = Wrapped(from - 1);
    from = other;
    count = size_ - count;
  }
  for (int k = 0; k < count; ++k) reversed_[order_[Wrapped(from + k)]] ^= 1;
  for (int k = 0; k < count / 2; ++k) {
    std::swap(order_[from], order_[to]);
    place_[order_[from]] = from;
    place_[order_[to]] = to;
    from = Wrapped(from + 1);
    to = Wrapped(to - 1);
  }
}

// Replaces the edges (a, b) and (c, d) by (a, c) and (b, d), where b follows a as d follows c, both
// forwards or both backwards.
void TourSearch::Exchange(int a, int b, int c, int d) {
  if (Next(a) != b || Next(c) != d) {
    std::swap(a, b);
    std::swap(c, d);
    std::swap(a, c);
    std::swap(b, d);
  }
  const Change change{place_[b], place_[c]};
  Reverse(change.from, change.to);
  log_.push_back(change);
}

int TourSearch::ReversalLength(int from, int to) const {
  const int apart = std::abs(place_[to] - place_[from]);
  return std::min(apart, size_ - apart);
}

void TourSearch::TakeBack(size_t mark) {
  while (log_.size() > mark) {
    Reverse(log_.back().from, log_.back().to);
    log_.pop_back();
  }
}

void TourSearch::Wake(int hover) {
  if (is_awake_[hover]) return;
  is_awake_[hover] = 1;
  awake_.push_back(hover);
}

TourSearch::TourSearch(PortCosts& costs, std::span<const std::vector<TourCandidate>> candidates,
                       const Order& start)
    : costs_(costs),
      candidates_(candidates),
      size_(static_cast<int>(start.hovers.size())),
      order_(start.hovers),
      place_(order_.size()),
      reversed_(start.reversed),
      is_awake_(order_.size()) {
  for (int k = 0; k < size_; ++k) place_[order_[k]] = k;
}

void TourSearch::Improve() {
  for (auto hover = order_.rbegin(); hover != order_.rend(); ++hover) Wake(*hover);
  ImproveAwake();
  log_.clear();
}

void TourSearch::Perturb(int count, std::mt19937_64& random) {
  for (int k = 0; k < count; ++k) {
    const double loss = SwapStretches(random);
    if (ImproveAwake() < loss + kLeastGain) TakeBack(0);
    log_.clear();
  }
}

double TourSearch::ImproveAwake() {
  double gain = 0;
  while (!awake_.empty()) {
    const int hover = awake_.back();
    awake_.pop_back();
    is_awake_[hover] = 0;
    for (double found = 1; found > 0; gain += found) found = ImproveAt(hover);
  }
  return gain;
}

double TourSearch::ImproveAt(int hover) {
  for (const bool forward : {true, false}) {
    if (const double gain = Chain(hover, forward); gain > 0) return gain;
  }
  for (const bool forward : {true, false}) {
    if (const double gain = MoveStretch(hover, forward); gain > 0) return gain;
  }
  return TurnOne(hover);
}

// Opens the edge from `first` to its neighbour and lets the open end wander.
double TourSearch::Chain(int first, bool forward) {
  const int last = forward ? Next(first) : Previous(first);
  const double open = costs_(Facing(first, forward), Facing(last, !forward));
  double best = kLeastGain;
  if (!Extend(0, first, last, open, best)) return 0;
  Wake(first);
  Wake(last);
  return best;
}

// `gain`: what the tour is shorter by while the edge from `last` to `first` is missing. Leaves the
// best tour found, or the tour as it was.
bool TourSearch::Extend(int depth, int first, int last, double gain, double& best) {
  const size_t level = static_cast<size_t>(depth);
  const size_t breadth = level < kBreadth.size() ? kBreadth[level] : 1;
  for (const Step& step : LookAhead(first, last, gain, breadth)) {
    const bool forward = Next(first) == last;
    const size_t mark = log_.size();
    const Port end = Facing(step.over, forward);
    const Port start = Facing(first, forward);
    bool better = costs_.IsBelow(end, start, step.gain - best);
    if (!better && ReversalLength(last, step.over) > kLongestTrial) continue;
    if (better) best = step.gain - costs_(end, start);
    Exchange(first, last, step.over, step.to);
    if (depth + 1 < kDeepest && Extend(depth + 1, first, step.over, step.gain, best)) better = true;
    if (better) {
      Wake(step.to);
      Wake(step.over);
      return true;
    }
    TakeBack(mark);
  }
  return false;
}

// first -> last ... over -> to: the edge (last, to) takes the place of (over, to).
std::vector<TourSearch::Step> TourSearch::LookAhead(int first, int last, double gain,
                                                    size_t breadth) {
  std::vector<Step> steps;
  const bool forward = Next(first) == last;
  const Port open = Facing(last, !forward);
  for (const TourCandidate& candidate : candidates_[last]) {
    if (candidate.cost >= gain) break;
    const int to = candidate.hover;
    if (to == first) continue;
    const int over = forward ? Previous(to) : Next(to);
    if (over == last) continue;
    const double added = costs_(open, Facing(to, !forward));
    if (added >= gain - kLeastGain) continue;
    const double removed = costs_(Facing(over, forward), Facing(to, !forward));
    steps.push_back({to, over, gain - added + removed});
  }
  const auto better = [](const Step& a, const Step& b) {
    return a.gain != b.gain ? a.gain > b.gain : a.to < b.to;
  };
  std::sort(steps.begin(), steps.end(), better);
  if (steps.size() > breadth) steps.resize(breadth);
  return steps;
}

// Moves the stretch of one to three hovers that begins with `hover` and leads away from the side
// `forward` looks to, so that `hover` comes to lie beside one of its candidates.
double TourSearch::MoveStretch(int hover, bool forward) {
  const auto step = [&](int from, bool ahead) { return ahead ? Next(from) : Previous(from); };
  const int before = step(hover, forward);
  int end = hover;
  for (int count = 1; count <= kLongestStretch; ++count, end = step(end, !forward)) {
    const int after = step(end, !forward);
    if (after == before) return 0;
    const Port near_port = Facing(hover, forward);
    const Port far_port = Facing(end, !forward);
    const double freed = costs_(near_port, Facing(before, !forward)) +
                         costs_(far_port, Facing(after, forward)) -
                         costs_(Facing(before, !forward), Facing(after, forward));
    for (const TourCandidate& candidate : candidates_[hover]) {
      if (candidate.cost >= freed) break;
      const int beside = candidate.hover;
      // Steps from the stretch's end to `beside`, were it part of the stretch.
      const int from_hover = forward ? Wrapped(place_[hover] - place_[beside])
                                     : Wrapped(place_[beside] - place_[hover]);
      if (from_hover < count) continue;
      for (const bool ahead : {true, false}) {
        const int other = step(beside, ahead);
        if (other == hover || other == end) continue;
        const Port to = Facing(other, !ahead);
        const double left =
            freed - costs_(near_port, Facing(beside, ahead)) + costs_(Facing(beside, ahead), to);
        if (!costs_.IsBelow(far_port, to, left - kLeastGain)) continue;
        const double gain = left - costs_(far_port, to);
        const bool same_way = ahead != forward;
        const int x = same_way ? beside : other;
        const int y = same_way ? other : beside;
        // before [hover .. end] after .. x y, read away from `before`: turn the whole, then the
        // part after the stretch back, then the stretch if it is to lie as it did.
        Exchange(before, hover, x, y);
        Exchange(before, x, after, end);
        if (same_way) Exchange(x, end, hover, y);
        for (const int changed : {before, hover, end, after, x, y}) Wake(changed);
        return gain;
      }
    }
  }
  return 0;
}

double TourSearch::TurnOne(int hover) {
  const Port from = Facing(Previous(hover), true);
  const Port to = Facing(Next(hover), false);
  const Port in = Facing(hover, false);
  const Port out = Facing(hover, true);
  const double gain = costs_(from, in) + costs_(out, to) - costs_(from, out) - costs_(in, to);
  if (!(gain > kLeastGain)) return 0;
  Exchange(Previous(hover), hover, hover, Next(hover));
  Wake(Previous(hover));
  Wake(Next(hover));
  return gain;
}

// A B C D becomes A C B D; returns what that costs.
double TourSearch::SwapStretches(std::mt19937_64& random) {
  const auto pick = [&](int count) { return static_cast<int>(random() % count); };
  const int longest = std::min(kLongestSwap, (size_ - 2) / 2);
  const int start = pick(size_);
  const int b_count = 1 + pick(longest);
  const int c_count = 1 + pick(longest);
  const auto at = [&](int offset) { return order_[Wrapped((start + offset) % size_)]; };
  const int a = at(0);
  const int b1 = at(1);
  const int b2 = at(b_count);
  const int c1 = at(b_count + 1);
  const int c2 = at(b_count + c_count);
  const int d = at(b_count + c_count + 1);
  const double loss = EdgeCost(a, c1) + EdgeCost(c2, b1) + EdgeCost(b2, d) - EdgeCost(a, b1) -
                      EdgeCost(b2, c1) - EdgeCost(c2, d);
  Exchange(a, b1, c2, d);
  Exchange(a, c2, c1, b2);
  Exchange(c2, b2, b1, d);
  for (const int changed : {a, b1, b2, c1, c2, d}) Wake(changed);
  return loss;
}

}  // namespace stucco::plan
