// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/map/wall_among.h"

#include <cmath>
#include <set>

#include "proxy/planes/densest.h"

namespace stucco {
namespace {

// How likely a wall is that far from where it is expected, but for a factor.
double Likelihood(double distance, const ExpectedWall& expected) {
  constexpr double kMostWalls = 0.7;
  const auto bell = [&](double sigma) {
    const double off = (distance - expected.distance) / sigma;
    return std::exp(-off * off / 2);
  };
  return kMostWalls * bell(expected.sigma) + (1 - kMostWalls) * bell(kMapSigma_m);
}

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
    const double score = static_cast<double>(last - first) * Likelihood(at, expected);
    if (score <= best) continue;
    best = score;
    strip = hits.subspan(first, last - first);
  }
  return strip;
}

}  // namespace

std::optional<double> WallAmong(std::span<const WallHit> hits, double level_of_detail,
                                const ExpectedWall& expected, double length) {
  constexpr double kCellArea_m2 = 0.25;
  constexpr double kLeastArea_m2 = 1.5;
  constexpr double kLeastPerMetre_m = 0.4;  // of height, along the run
  const auto near = BestStrip(hits, level_of_detail, expected);
  std::set<std::pair<int, int>> cells;
  for (const WallHit& hit : near) cells.insert(hit.cell);
  const double area = kCellArea_m2 * static_cast<double>(cells.size());
  if (area < std::max(kLeastArea_m2, kLeastPerMetre_m * length)) return std::nullopt;
  const auto flat = BestStrip(near, kFlat_m, expected);
  double sum = 0;
  for (const WallHit& hit : flat) sum += hit.distance;
  return sum / static_cast<double>(flat.size());
}

}  // namespace stucco
