// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/evaluate/target_all.h"

#include "plan/evaluate/facade_sight.h"
#include "survey/parallel.h"

namespace stucco::plan {

void TargetAllSeen(const Site& site, const CameraPreset& camera, double d_max_m,
                   std::vector<Hover>& hovers, int threads) {
  const FacadeSight sight(site, camera, d_max_m, hovers);
  std::vector<std::vector<SeenView>> views(site.facades.size());
  ParallelFor(views.size(), threads,
              [&](size_t i) { views[i] = sight.ViewsOf(static_cast<int>(i)); });
  for (size_t i = 0; i < views.size(); ++i) {
    const int facade = static_cast<int>(i);
    for (const SeenView& view : views[i]) {
      hovers[view.place].shots[view.picture].targets.push_back(
          BoxAround(sight.grid(facade), facade, view.cells));
    }
  }
}

}  // namespace stucco::plan
