// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "evaluate/geometry/part_figures.h"

#include <cassert>
#include <functional>

#include "evaluate/geometry/seen.h"
#include "survey/median.h"

namespace stucco::evaluate {
namespace {

using IsPart = std::function<bool(int group)>;

PartFigures OfParts(const std::function<SurfaceFigures(const IsPart&)>& of) {
  const auto of_class = [&](FacetClass facet_class) {
    return of([=](int group) { return group == static_cast<int>(facet_class); });
  };
  return {.all = of([](int) { return true; }),
          .building = of(IsOfBuilding),
          .wall = of_class(FacetClass::kWall),
          .roof = of_class(FacetClass::kRoof),
          .ground = of_class(FacetClass::kGround)};
}

SurfaceFigures FiguresOf(const ResultPoints& result, const TruthPoints& truth,
                         std::span<const char> found, const IsPart& is_part) {
  SurfaceFigures figures;
  std::vector<double> distances;
  for (size_t i = 0; i < result.distances.size(); ++i) {
    if (is_part(result.groups[i])) distances.push_back(result.distances[i]);
  }
  figures.error95_m = Quantile(std::move(distances), 0.95).value_or(kNotMeasured);
  const auto complete = [&](char photos) {
    double wanted = 0;
    double there = 0;
    for (size_t i = 0; i < truth.points.size(); ++i) {
      if (!is_part(truth.points[i].group) || truth.showing[i] < photos) continue;
      wanted += 1;
      there += found[i];
    }
    return wanted > 0 ? there / wanted : kNotMeasured;
  };
  figures.completeness = complete(1);
  figures.completeness_of_three = complete(kPhotosToConfirm);
  figures.completeness_all = complete(0);
  return figures;
}

}  // namespace

PartFigures FiguresOf(const ResultPoints& result, const TruthPoints& truth,
                      std::span<const char> found) {
  assert(truth.showing.size() == truth.points.size() && found.size() == truth.points.size());
  return OfParts([&](const IsPart& is_part) { return FiguresOf(result, truth, found, is_part); });
}

PartFigures FiguresOf(const ResultPoints& result, const TruthPoints& truth,
                      std::span<const double> distances, double tolerance_m) {
  assert(truth.showing.size() == truth.points.size() && distances.size() == truth.points.size());
  std::vector<char> found;
  found.reserve(distances.size());
  for (const double distance : distances) found.push_back(distance <= tolerance_m ? 1 : 0);
  return OfParts([&](const IsPart& is_part) {
    SurfaceFigures figures = FiguresOf(result, truth, found, is_part);
    std::vector<double> of_seen;
    for (size_t i = 0; i < distances.size(); ++i) {
      if (is_part(truth.points[i].group) && truth.showing[i] > 0) of_seen.push_back(distances[i]);
    }
    figures.seen95_m = Quantile(std::move(of_seen), 0.95).value_or(kNotMeasured);
    return figures;
  });
}

}  // namespace stucco::evaluate
