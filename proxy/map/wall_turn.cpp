// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/map/wall_turn.h"

#include <algorithm>
#include <cmath>

namespace stucco {
namespace {

// The hits of a wall by metres along and away from its edge.
class Histogram {
 public:
  Histogram(std::span<const WallHit> hits, double length)
      : columns_(1 + static_cast<size_t>(length / kColumn_m)), counts_(columns_ * kRows, 0) {
    for (const WallHit& hit : hits) {
      const double column = (hit.along + length / 2) / kColumn_m;
      const auto c = std::clamp(column, 0.0, static_cast<double>(columns_ - 1));
      counts_[static_cast<size_t>(c) * kRows + RowOf(hit.distance)] += 1;
    }
  }

  // Most hits in one line of this slope, those near it counted by how near they are, weighted by
  // how likely a wall is there.
  double Best(double slope, std::span<const double> likelihood_of_row) const {
    std::vector<double> line(kRows, 0);
    const double middle = static_cast<double>(columns_) / 2;
    for (size_t c = 0; c < columns_; ++c) {
      const double along = (static_cast<double>(c) + 0.5 - middle) * kColumn_m;
      const double down = slope * along / kRow_m;  // rows, not whole ones
      const double whole = std::floor(down);
      const double part = down - whole;
      const auto by = static_cast<std::ptrdiff_t>(whole);
      for (size_t row = 0; row < kRows; ++row) {
        const double count = counts_[c * kRows + row];
        if (count == 0) continue;
        Add(static_cast<std::ptrdiff_t>(row) - by, count * (1 - part), line);
        Add(static_cast<std::ptrdiff_t>(row) - by - 1, count * part, line);
      }
    }
    double best = 0;
    for (size_t row = 0; row < kRows; ++row) {
      best = std::max(best, Near(line, row) * likelihood_of_row[row]);
    }
    return best;
  }

  static constexpr double kRow_m = 0.02;
  static constexpr size_t kRows = 1 + static_cast<size_t>(2 * kMapReach_m / kRow_m);
  static double DistanceOf(size_t row) { return static_cast<double>(row) * kRow_m - kMapReach_m; }

 private:
  static constexpr double kColumn_m = 0.5;
  static constexpr std::ptrdiff_t kReach = 4;  // rows: what stereo makes of a flat wall

  static size_t RowOf(double distance) {
    const double row = std::round((distance + kMapReach_m) / kRow_m);
    return static_cast<size_t>(std::clamp(row, 0.0, static_cast<double>(kRows - 1)));
  }
  static void Add(std::ptrdiff_t row, double count, std::vector<double>& line) {
    if (row >= 0 && row < static_cast<std::ptrdiff_t>(kRows)) line[row] += count;
  }
  static double Near(const std::vector<double>& line, size_t row) {
    double sum = 0;
    const auto at = static_cast<std::ptrdiff_t>(row);
    const auto end = std::min(at + kReach, static_cast<std::ptrdiff_t>(kRows));
    for (auto r = std::max<std::ptrdiff_t>(0, at - kReach + 1); r < end; ++r) {
      sum += line[r] * static_cast<double>(kReach - std::abs(r - at));
    }
    return sum / kReach;
  }

  size_t columns_;
  std::vector<double> counts_;  // by column, then row
};

// Metres over which hits are spread as evenly as these are.
double SpanOf(std::span<const WallHit> hits) {
  if (hits.empty()) return 0;
  double sum = 0, squares = 0;
  for (const WallHit& hit : hits) {
    sum += hit.along;
    squares += hit.along * hit.along;
  }
  const auto count = static_cast<double>(hits.size());
  const double mean = sum / count;
  return std::sqrt(12 * std::max(0.0, squares / count - mean * mean));
}

}  // namespace

WallTurn TurnAmong(std::span<const WallHit> hits, const ExpectedWall& expected, double length) {
  constexpr double kStep_rad = 0.001;
  constexpr int kSteps = 40;
  constexpr double kSigma_rad = 0.03;  // corners off by 0.2 m, walls of 10 m
  if (hits.empty()) return {};
  std::vector<double> likelihood;
  likelihood.reserve(Histogram::kRows);
  for (size_t row = 0; row < Histogram::kRows; ++row) {
    likelihood.push_back(LikelihoodOf(Histogram::DistanceOf(row), expected));
  }
  const Histogram histogram(hits, length);
  double best = 0, unturned = 0;
  WallTurn found;
  for (int step = -kSteps; step <= kSteps; ++step) {
    const double turn = step * kStep_rad;
    const double sigmas = turn / kSigma_rad;
    const double score = histogram.Best(-turn, likelihood) * std::exp(-sigmas * sigmas / 2);
    if (step == 0) unturned = score;
    if (score <= best) continue;
    best = score;
    found.turn = turn;
  }
  found.span = SpanOf(hits);
  if (unturned > 0) found.gain = best / unturned;
  return found;
}

std::vector<WallHit> Turned(std::span<const WallHit> hits, double turn) {
  std::vector<WallHit> turned;
  turned.reserve(hits.size());
  for (WallHit hit : hits) {
    hit.distance += turn * hit.along;
    if (std::abs(hit.distance) <= kMapReach_m) turned.push_back(hit);
  }
  std::ranges::sort(turned, {}, &WallHit::distance);
  return turned;
}

}  // namespace stucco
