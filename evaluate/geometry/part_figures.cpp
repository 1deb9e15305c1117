// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "evaluate/geometry/part_figures.h"

#include <cassert>
#include <functional>

#include "survey/median.h"

namespace stucco::evaluate {
namespace {

using IsPart = std::function<bool(int group)>;

SurfaceFigures FiguresOf(const ResultPoints& result, const TruthPoints& truth,
                         std::span<const char> found, const IsPart& is_part) {
  SurfaceFigures figures;
  std::vector<double> distances;
  for (size_t i = 0; i < result.distances.size(); ++i) {
    if (is_part(result.groups[i])) distances.push_back(result.distances[i]);
  }
  figures.error95_m = Quantile(std::move(distances), 0.95).value_or(kNotMeasured);
  double seen = 0, seen_found = 0, all = 0, all_found = 0;
  for (size_t i = 0; i < truth.points.size(); ++i) {
    if (!is_part(truth.points[i].group)) continue;
    all += 1;
    all_found += found[i];
    if (!truth.seen[i]) continue;
    seen += 1;
    seen_found += found[i];
  }
  if (seen > 0) figures.completeness = seen_found / seen;
  if (all > 0) figures.completeness_all = all_found / all;
  return figures;
}

}  // namespace

PartFigures FiguresOf(const ResultPoints& result, const TruthPoints& truth,
                      std::span<const char> found) {
  assert(truth.seen.size() == truth.points.size() && found.size() == truth.points.size());
  const auto of = [&](const IsPart& is_part) { return FiguresOf(result, truth, found, is_part); };
  const auto of_class = [&](FacetClass facet_class) {
    return of([=](int group) { return group == static_cast<int>(facet_class); });
  };
  return {.all = of([](int) { return true; }),
          .building = of(IsOfBuilding),
          .wall = of_class(FacetClass::kWall),
          .roof = of_class(FacetClass::kRoof),
          .ground = of_class(FacetClass::kGround)};
}

}  // namespace stucco::evaluate
