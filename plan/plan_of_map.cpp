// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/plan_of_map.h"

namespace stucco::plan {

Plan PlanOfMap(const Site& site) {
  Plan plan;
  plan.crs = site.crs;
  plan.origin = site.origin;
  plan.d_min_m = site.d_min_m;
  plan.safe_altitude_m = site.safe_altitude_m;
  plan.min_altitude_m = site.min_altitude_m;
  plan.home_m = site.home;
  for (const Footprint& footprint : site.footprints) {
    plan.footprints.push_back({footprint.building, footprint.outline.rings, footprint.z_m,
                               footprint.blocked_to_m, footprint.is_obstacle});
  }
  for (const Polygon& polygon : site.no_fly) {
    for (const Ring& ring : polygon.rings) plan.no_fly_m.push_back(ring);
  }
  for (const Facade& facade : site.facades) {
    PlannedFacade& planned = plan.facades.emplace_back();
    planned.id = facade.id;
    planned.a_m = facade.a;
    planned.b_m = facade.b;
    planned.z_m = facade.z_m;
    planned.top_known = facade.top_known;
  }
  return plan;
}

}  // namespace stucco::plan
