// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/dipping/select.h"

#include <algorithm>
#include <numeric>

#include "plan/dipping/coverage.h"
#include "survey/parallel.h"

namespace stucco::plan {
namespace {

std::vector<CoverCounts> CountViews(size_t facades, const std::vector<DippingPoint>& points) {
  std::vector<std::vector<double>> ends(facades);
  for (const DippingPoint& point : points) {
    for (const WallView& view : point.views) {
      for (const Interval& part : view.seen) {
        ends[view.facade].push_back(part.from_m);
        ends[view.facade].push_back(part.to_m);
      }
    }
  }
  std::vector<CoverCounts> counts;
  counts.reserve(facades);
  for (std::vector<double>& some : ends) counts.emplace_back(std::move(some));
  for (const DippingPoint& point : points) {
    for (const WallView& view : point.views) counts[view.facade].Add(view.seen);
  }
  return counts;
}

// Takes the views out of the counts when every part of them is in another view too.
bool TakeOut(std::vector<CoverCounts>& counts, std::span<const WallView> views) {
  for (const WallView& view : views) counts[view.facade].Remove(view.seen);
  const bool spare = std::all_of(views.begin(), views.end(), [&](const WallView& view) {
    return counts[view.facade].IsCovered(view.seen, 1);
  });
  if (!spare) {
    for (const WallView& view : views) counts[view.facade].Add(view.seen);
  }
  return spare;
}

// Indices in ascending order of value, equal ones by index.
std::vector<size_t> Ascending(const std::vector<double>& values) {
  std::vector<size_t> order(values.size());
  std::iota(order.begin(), order.end(), size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](size_t i, size_t j) { return values[i] < values[j]; });
  return order;
}

}  // namespace

std::vector<DippingPoint> SelectPoints(const DippingSetting& setting,
                                       std::vector<DippingPoint> points) {
  std::vector<std::vector<double>> scores(points.size());
  std::vector<double> sums(points.size());
  ParallelFor(points.size(), setting.threads, [&](size_t i) {
    for (const WallView& view : points[i].views) {
      scores[i].push_back(ScoreOf(setting, points[i].position, view));
    }
    sums[i] = std::accumulate(scores[i].begin(), scores[i].end(), 0.0);
  });
  std::vector<CoverCounts> counts = CountViews(setting.site.facades.size(), points);
  for (const size_t i : Ascending(sums)) {
    if (TakeOut(counts, points[i].views)) points[i].views.clear();
  }

  std::vector<std::pair<size_t, size_t>> views;
  std::vector<double> view_scores;
  for (size_t i = 0; i < points.size(); ++i) {
    for (size_t k = 0; k < points[i].views.size(); ++k) {
      views.emplace_back(i, k);
      view_scores.push_back(scores[i][k]);
    }
  }
  for (const size_t index : Ascending(view_scores)) {
    const auto [i, k] = views[index];
    WallView& view = points[i].views[k];
    if (TakeOut(counts, {&view, 1})) view.seen.clear();
  }
  for (DippingPoint& point : points) {
    std::erase_if(point.views, [](const WallView& view) { return view.seen.empty(); });
  }
  std::erase_if(points, [](const DippingPoint& point) { return point.views.empty(); });
  return points;
}

}  // namespace stucco::plan
