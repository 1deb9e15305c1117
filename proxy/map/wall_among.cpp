// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/map/wall_among.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include "proxy/planes/densest.h"

namespace stucco {
namespace {

// With so many hits where a wall peaks tells more than the mean of all that stereo makes of it.
constexpr size_t kEnoughHits = 200;

// The hits in the strip of this width that holds most of them, weighted by its likelihood.
std::span<const WallHit> BestStrip(std::span<const WallHit> hits, double width,
                                   const ExpectedWall& expected) {
  constexpr double kStep_m = 0.02;
  double best = 0;
  size_t first = 0, last = 0;
  std::span<const WallHit> strip;
  for (double at = -kMapReach_m; at <= kMapReach_m; at += kStep_m) {
    while (last < hits.size() && hits[last].distance <= at + width / 2) ++last;
    while (first < last && hits[first].distance < at - width / 2) ++first;
    const double score = static_cast<double>(last - first) * LikelihoodOf(at, expected);
    if (score <= best) continue;
    best = score;
    strip = hits.subspan(first, last - first);
  }
  return strip;
}

double MeanOf(std::span<const WallHit> hits) {
  double sum = 0;
  for (const WallHit& hit : hits) sum += hit.distance;
  return sum / static_cast<double>(hits.size());
}

// Squares of the wall in which hits lie.
size_t CellsOf(std::span<const WallHit> hits) {
  std::set<std::pair<int, int>> cells;
  for (const WallHit& hit : hits) cells.insert(hit.cell);
  return cells.size();
}

// How many times as much as what was found a strip so far behind it covers, to be the wall. Panes
// lie up to half a metre behind a wall, and may be most of what is seen of it; what lies farther in
// are loggias, of which fronts are a third or more, or the wall behind balconies.
double TimesOfWall(double depth) {
  constexpr double kDeepest_m = 0.6;  // of panes
  constexpr double kPanes = 4, kLoggias = 3;
  return depth < kDeepest_m ? kPanes : kLoggias;
}

// The wall behind what was found where it was expected, if that is fronts of balconies: a strip
// farther in that covers several times as much. Empty: there is none.
std::span<const WallHit> WallBehind(std::span<const WallHit> hits, std::span<const WallHit> found,
                                    double width) {
  if (found.empty()) return {};
  const auto end = std::ranges::lower_bound(hits, found.front().distance, {}, &WallHit::distance);
  constexpr ExpectedWall kAnywhere{.distance = 0, .sigma = 1e6};
  const auto behind = BestStrip({hits.begin(), end}, width, kAnywhere);
  if (behind.empty()) return {};
  const double times = TimesOfWall(MeanOf(found) - MeanOf(behind));
  const bool is_wall =
      static_cast<double>(CellsOf(behind)) > times * static_cast<double>(CellsOf(found));
  return is_wall ? behind : std::span<const WallHit>();
}

// Where hits peak, in strips of this width around places a centimetre apart.
class Peaks {
 public:
  explicit Peaks(std::span<const WallHit> hits) : hits_(hits), from_(hits.front().distance) {
    const auto places = 1 + static_cast<size_t>((hits.back().distance - from_) / kStep_m);
    for (size_t i = 0; i < places; ++i) {
      counts_.push_back(static_cast<double>(Strip(i).size()));
    }
  }

  // Windows stand behind their wall, and there may be more of them: the outermost peak within their
  // depth of the highest one, if it is a peak of its own. The mean of what is there.
  double OfWall() const {
    const size_t highest = std::ranges::max_element(counts_) - counts_.begin();
    size_t wall = highest;
    double valley = counts_[highest];
    const size_t end =
        std::min(counts_.size(), highest + 1 + static_cast<size_t>(kReveal_m / kStep_m));
    for (size_t i = highest + 1; i < end; ++i) {
      valley = std::min(valley, counts_[i]);
      const bool is_apart = valley <= kValley * counts_[i];
      if (is_apart && counts_[i] >= kLeastWall * counts_[highest] && IsHighest(i)) wall = i;
    }
    return MeanOf(Strip(wall));
  }

 private:
  static constexpr double kStep_m = 0.01;
  static constexpr double kHalf_m = 0.02;
  static constexpr size_t kAround = 3;  // steps that a peak is the highest within
  static constexpr double kReveal_m = 0.16;
  static constexpr double kLeastWall = 0.25;  // of the windows' hits
  static constexpr double kValley = 0.6;

  std::span<const WallHit> Strip(size_t place) const {
    const double at = from_ + kStep_m * static_cast<double>(place);
    const auto begin = std::ranges::lower_bound(hits_, at - kHalf_m, {}, &WallHit::distance);
    const auto end = std::ranges::upper_bound(hits_, at + kHalf_m, {}, &WallHit::distance);
    return {begin, end};
  }
  bool IsHighest(size_t place) const {
    const size_t first = place - std::min(place, kAround);
    const size_t last = std::min(counts_.size(), place + kAround + 1);
    return std::ranges::all_of(std::span(counts_).subspan(first, last - first),
                               [&](double count) { return count <= counts_[place]; });
  }

  std::span<const WallHit> hits_;
  double from_;
  std::vector<double> counts_;
};

}  // namespace

double LikelihoodOf(double distance, const ExpectedWall& expected) {
  constexpr double kMostWalls = 0.7;
  const auto bell = [&](double sigma) {
    const double off = (distance - expected.distance) / sigma;
    return std::exp(-off * off / 2);
  };
  return kMostWalls * bell(expected.sigma) + (1 - kMostWalls) * bell(kMapSigma_m);
}

std::optional<double> WallAmong(std::span<const WallHit> hits, double level_of_detail,
                                const ExpectedWall& expected, double length) {
  constexpr double kCellArea_m2 = 0.25;
  constexpr double kLeastArea_m2 = 1.5;
  constexpr double kLeastPerMetre_m = 0.4;  // of height, along the run
  ExpectedWall where = expected;
  auto near = BestStrip(hits, level_of_detail, where);
  const auto behind = WallBehind(hits, near, level_of_detail);
  if (!behind.empty()) {
    near = behind;
    where.distance = MeanOf(behind);
  }
  const double area = kCellArea_m2 * static_cast<double>(CellsOf(near));
  if (area < std::max(kLeastArea_m2, kLeastPerMetre_m * length)) return std::nullopt;
  const auto flat = BestStrip(near, kFlat_m, where);
  if (flat.size() < kEnoughHits) return MeanOf(flat);
  // What the strip holds, and what windows that it has found may have before them.
  const double end = flat.back().distance + kFlat_m;
  const auto last = std::ranges::upper_bound(near, end, {}, &WallHit::distance);
  return Peaks({flat.begin(), last}).OfWall();
}

}  // namespace stucco
