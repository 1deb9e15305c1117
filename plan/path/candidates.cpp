// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/path/candidates.h"

#include <algorithm>

#include "plan/path/nearest.h"
#include "survey/parallel.h"

namespace stucco::plan {

using Eigen::Vector3d;

namespace {

constexpr size_t kNearest = 30;   // looked at: those of a facade cost half of what others do
constexpr size_t kMeasured = 14;  // of which the shortest safe path is searched
constexpr size_t kKept = 10;

bool IsCheaper(const TourCandidate& a, const TourCandidate& b) {
  return a.cost != b.cost ? a.cost < b.cost : a.hover < b.hover;
}

TourCandidate Measure(const HoverCosts& costs, int i, int j) {
  const double length = costs.Length(i, j);
  return {j, length, HoverCosts::Cost(costs.Weight(i, j), length, costs.LeastTurn(i, j))};
}

std::vector<int> NearestInQuadrants(const HoverCosts& costs, const NearestPoints& points, int i) {
  std::vector<int> found;
  const Vector3d& at = costs.Position(i);
  for (int quadrant = 0; quadrant < 4; ++quadrant) {
    const auto accept = [&](int j) {
      const Vector3d d = costs.Position(j) - at;
      if (d.x() == 0 && d.y() == 0) return false;
      const int of_j = d.x() > 0 ? (d.y() > 0 ? 0 : d.y() < 0 ? 3 : 0) : d.y() > 0 ? 1 : 2;
      return of_j == quadrant && j != i;
    };
    for (const int j : points.Find(at, 1, accept)) found.push_back(j);
  }
  return found;
}

std::vector<TourCandidate> CandidatesOf(const HoverCosts& costs, const NearestPoints& points,
                                        int i) {
  std::vector<TourCandidate> found;
  for (const int j : points.Find(costs.Position(i), kNearest, [&](int j) { return j != i; })) {
    found.push_back({j, 0, costs.LeastCost(i, j)});
  }
  std::sort(found.begin(), found.end(), IsCheaper);
  if (found.size() > kMeasured) found.resize(kMeasured);
  for (TourCandidate& candidate : found) candidate = Measure(costs, i, candidate.hover);
  std::sort(found.begin(), found.end(), IsCheaper);
  if (found.size() > kKept) found.resize(kKept);
  for (const int j : NearestInQuadrants(costs, points, i)) {
    if (std::none_of(found.begin(), found.end(), [&](const auto& c) { return c.hover == j; })) {
      found.push_back(Measure(costs, i, j));
    }
  }
  std::sort(found.begin(), found.end(), IsCheaper);
  return found;
}

}  // namespace

std::vector<std::vector<TourCandidate>> FindCandidates(const HoverCosts& costs, int threads) {
  std::vector<Vector3d> positions;
  positions.reserve(costs.size());
  for (int k = 0; k < costs.size(); ++k) positions.push_back(costs.Position(k));
  const NearestPoints points(positions);
  std::vector<std::vector<TourCandidate>> candidates(positions.size());
  ParallelFor(candidates.size(), threads,
              [&](size_t k) { candidates[k] = CandidatesOf(costs, points, static_cast<int>(k)); });
  return candidates;
}

}  // namespace stucco::plan
