// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "site/site_of_plan.h"

#include <algorithm>
#include <map>
#include <string>

namespace stucco {
namespace {

constexpr double kOnOutline_m = 0.01;  // plans are rounded to millimetres

using ByBuilding = std::multimap<std::string, int>;  // indices of footprints

bool IsOn(const Footprint& footprint, const PlannedFacade& facade) {
  if (!(facade.z_m.from_m < footprint.z_m.to_m && footprint.z_m.from_m < facade.z_m.to_m)) {
    return false;
  }
  const Eigen::Vector2d middle = (facade.a_m + facade.b_m) / 2;
  return std::ranges::any_of(footprint.outline.rings, [&](const Ring& ring) {
    for (size_t i = 0; i < ring.size(); ++i) {
      if (Distance(Segment2d{ring[i], ring[(i + 1) % ring.size()]}, middle) < kOnOutline_m) {
        return true;
      }
    }
    return false;
  });
}

// The footprint of the facade's building (B0012 of B0012/F03) that it is a wall of; -1: none.
int FootprintOf(const PlannedFacade& facade, const Site& site, const ByBuilding& footprints) {
  const auto [begin, end] = footprints.equal_range(facade.id.substr(0, facade.id.find('/')));
  const auto found = std::find_if(
      begin, end, [&](const auto& entry) { return IsOn(site.footprints[entry.second], facade); });
  return found == end ? -1 : found->second;
}

void AddFacades(const Plan& plan, const ByBuilding& footprints, Site& site) {
  for (const PlannedFacade& facade : plan.facades) {
    const int footprint = FootprintOf(facade, site, footprints);
    site.facades.push_back(
        {facade.id, footprint, facade.a_m, facade.b_m, facade.z_m, facade.top_known});
    if (footprint < 0) continue;
    site.footprints[footprint].in_area = true;
    site.footprints[footprint].top_known = facade.top_known;
  }
}

}  // namespace

Site SiteOfPlan(const Plan& plan) {
  Site site;
  site.crs = plan.crs;
  site.origin = plan.origin;
  site.no_fly = PolygonsOf(plan.no_fly_m);
  site.home = plan.home_m;
  site.ground = GroundRule::kNearestFoot;
  site.d_min_m = plan.d_min_m;
  site.safe_altitude_m = plan.safe_altitude_m;
  site.min_altitude_m = plan.min_altitude_m;
  ByBuilding footprints;
  for (const PlannedFootprint& planned : plan.footprints) {
    footprints.emplace(planned.building, static_cast<int>(site.footprints.size()));
    site.footprints.push_back({.building = planned.building,
                               .outline = {planned.rings_m},
                               .z_m = planned.z_m,
                               .blocked_to_m = planned.blocked_to_m,
                               .in_area = false,
                               .is_obstacle = planned.is_obstacle});
  }
  AddFacades(plan, footprints, site);
  return site;
}

}  // namespace stucco
