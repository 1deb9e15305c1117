// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/evaluate/target_all.h"

#include <algorithm>

#include "plan/evaluate/facade_views.h"
#include "survey/parallel.h"

namespace stucco::plan {
namespace {

Target BoxAround(const FacadeGrid& grid, int facade, const std::vector<uint32_t>& cells) {
  Target box{facade, grid.Along(cells.front()), grid.Heights(cells.front())};
  for (const uint32_t cell : cells) {
    const Interval along = grid.Along(cell), z = grid.Heights(cell);
    box.along_m = {std::min(box.along_m.from_m, along.from_m),
                   std::max(box.along_m.to_m, along.to_m)};
    box.z_m = {std::min(box.z_m.from_m, z.from_m), std::max(box.z_m.to_m, z.to_m)};
  }
  return box;
}

}  // namespace

void TargetAllSeen(const Site& site, const CameraPreset& camera, double d_max_m,
                   std::vector<Hover>& hovers, int threads) {
  const FacadeSight sight(site, camera, d_max_m, hovers);
  std::vector<std::vector<SeenView>> views(site.facades.size());
  ParallelFor(views.size(), threads,
              [&](size_t i) { views[i] = sight.ViewsOf(static_cast<int>(i)); });
  for (size_t i = 0; i < views.size(); ++i) {
    const int facade = static_cast<int>(i);
    for (const SeenView& view : views[i]) {
      hovers[view.hover].shots[view.shot].targets.push_back(
          BoxAround(sight.grid(facade), facade, view.cells));
    }
  }
}

}  // namespace stucco::plan
