// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/map/wall_among.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace stucco {
namespace {

// Where `hits` lie closest together. A wall is flat, but for its windows, which stand a hand or
// more behind it: the mean of all would lie between the two.
double DensestOf(std::span<const WallHit> hits) {
  constexpr double kFlat_m = 0.06;
  size_t last = 0;
  std::pair<size_t, size_t> most{0, 0};
  for (size_t first = 0; first < hits.size(); ++first) {
    while (last < hits.size() && hits[last].distance <= hits[first].distance + 2 * kFlat_m) ++last;
    if (last - first > most.second - most.first) most = {first, last};
  }
  double sum = 0;
  for (size_t k = most.first; k < most.second; ++k) sum += hits[k].distance;
  return sum / static_cast<double>(most.second - most.first);
}

}  // namespace

std::optional<double> WallAmong(std::span<const WallHit> hits, double level_of_detail,
                                double expected, double length) {
  constexpr double kCellArea_m2 = 0.25;
  constexpr double kLeastArea_m2 = 1.5;
  constexpr double kLeastPerMetre_m = 0.4;  // of height, along the run
  const double half = level_of_detail / 2;
  double best = 0;
  size_t first = 0, last = 0;
  std::pair<size_t, size_t> window;
  constexpr double kStep_m = 0.02;
  for (double at = -kMapReach_m; at <= kMapReach_m; at += kStep_m) {
    while (last < hits.size() && hits[last].distance <= at + half) ++last;
    while (first < last && hits[first].distance < at - half) ++first;
    if (last == first) continue;
    const double off = (at - expected) / kMapSigma_m;
    const double score = static_cast<double>(last - first) * std::exp(-off * off / 2);
    if (score <= best) continue;
    best = score;
    window = {first, last};
  }
  std::set<std::pair<int, int>> cells;
  for (size_t k = window.first; k < window.second; ++k) cells.insert(hits[k].cell);
  const double area = kCellArea_m2 * static_cast<double>(cells.size());
  if (area < std::max(kLeastArea_m2, kLeastPerMetre_m * length)) return std::nullopt;
  return DensestOf(hits.subspan(window.first, window.second - window.first));
}

}  // namespace stucco
