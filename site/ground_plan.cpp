// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "site/internal/ground_plan.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "survey/rasterize.h"

namespace stucco::internal {
namespace {

GroundPlan EmptyGroundPlan(const Eigen::AlignedBox2d& area, double cell_m) {
  GroundPlan ground;
  ground.cell_m = cell_m;
  ground.low = area.min();
  ground.columns = static_cast<int>(std::ceil(area.sizes().x() / cell_m));
  ground.rows = static_cast<int>(std::ceil(area.sizes().y() / cell_m));
  const size_t count = static_cast<size_t>(ground.columns) * ground.rows;
  ground.nearest.assign(count, -1);
  ground.covered.assign(count, false);
  return ground;
}

// Marks the cells whose middle is inside the footprint; false where there are none.
bool Cover(const Footprint& footprint, int index, GroundPlan& ground) {
  const Eigen::AlignedBox2d bounds = BoundsOf(footprint.outline);
  const Eigen::Vector2i first = ground.CellOf(bounds.min());
  const Eigen::Vector2i size = ground.CellOf(bounds.max()) - first + Eigen::Vector2i::Ones();
  bool any = false;
  std::vector<Ring> rings = footprint.outline.rings;
  for (auto& ring : rings) {
    for (Eigen::Vector2d& p : ring) p = (p - ground.low) / ground.cell_m - first.cast<double>();
  }
  const std::vector<uint8_t> inside = RasterizeRings(rings, size.x(), size.y());
  for (int row = 0; row < size.y(); ++row) {
    for (int column = 0; column < size.x(); ++column) {
      if (!inside[static_cast<size_t>(row) * size.x() + column]) continue;
      const auto cell = ground.Cell(first.x() + column, first.y() + row);
      if (!cell) continue;
      ground.covered[*cell] = true;
      ground.nearest[*cell] = index;
      any = true;
    }
  }
  return any;
}

// Hands the index of a footprint on from cell to cell.
void SpreadNearest(GroundPlan& ground) {
  std::vector<size_t> front;
  for (size_t cell = 0; cell < ground.nearest.size(); ++cell) {
    if (ground.nearest[cell] >= 0) front.push_back(cell);
  }
  for (size_t i = 0; i < front.size(); ++i) {
    const int column = static_cast<int>(front[i] % ground.columns);
    const int row = static_cast<int>(front[i] / ground.columns);
    for (const auto& [dx, dy] : {std::pair(1, 0), {-1, 0}, {0, 1}, {0, -1}}) {
      const auto next = ground.Cell(column + dx, row + dy);
      if (!next || ground.nearest[*next] >= 0) continue;
      ground.nearest[*next] = ground.nearest[front[i]];
      front.push_back(*next);
    }
  }
}

}  // namespace

Eigen::AlignedBox2d BoundsWithMargin(const Site& site, double margin_m) {
  Eigen::AlignedBox2d area;
  for (const Footprint& footprint : site.footprints) area.extend(BoundsOf(footprint.outline));
  const Eigen::Vector2d margin = Eigen::Vector2d::Constant(margin_m);
  return area.isEmpty() ? area : Eigen::AlignedBox2d(area.min() - margin, area.max() + margin);
}

GroundPlan MakeGroundPlan(const Site& site, const Eigen::AlignedBox2d& area, double cell_m) {
  GroundPlan ground = EmptyGroundPlan(area, cell_m);
  std::vector<int> small;  // cover no cell, but say how high the ground is
  for (int i = 0; i < static_cast<int>(site.footprints.size()); ++i) {
    if (!Cover(site.footprints[i], i, ground)) small.push_back(i);
  }
  for (const int i : small) {
    const Eigen::Vector2i place = ground.CellOf(BoundsOf(site.footprints[i].outline).center());
    const auto cell = ground.Cell(place.x(), place.y());
    if (cell && ground.nearest[*cell] < 0) ground.nearest[*cell] = i;
  }
  SpreadNearest(ground);
  return ground;
}

}  // namespace stucco::internal
