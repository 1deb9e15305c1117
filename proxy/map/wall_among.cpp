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

// Where `hits` lie closest together.
double DensestOf(std::span<const WallHit> hits) {
  std::vector<double> distances;
  distances.reserve(hits.size());
  for (const WallHit& hit : hits) distances.push_back(hit.distance);
  return MeanOfDensest(distances, kFlat_m);
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
