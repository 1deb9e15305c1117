// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/map/closed_off.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <set>
#include <string>

#include "plan/map/internal/ogr.h"
#include "survey/error.h"
#include "survey/geometry2d.h"

namespace stucco::plan {
namespace {

// Around all that is planned; what lies farther away nothing flies to anyway.
constexpr double kBeyond_m = 2000;

Polygon BoxAround(const Site& site) {
  Eigen::AlignedBox2d box = BoundsOf(site.area);
  box.extend(site.home.head<2>());
  for (const Polygon& zone : site.no_fly) box.extend(BoundsOf(zone));
  const Eigen::Vector2d low = box.min().array() - kBeyond_m, high = box.max().array() + kBeyond_m;
  return {{{low, {high.x(), low.y()}, high, {low.x(), high.y()}}}};
}

Polygon FilledHole(const Polygon& zone, size_t hole) {
  Ring border = zone.rings[hole];
  std::ranges::reverse(border);  // as outer rings run
  return {{std::move(border)}};
}

// What the zone parts from home: its holes, or all around it where home is in one of these.
std::vector<Polygon> PartedBy(const Polygon& zone, const Site& site) {
  std::vector<Polygon> parted;
  for (size_t hole = 1; hole < zone.rings.size(); ++hole) {
    const Polygon pocket = FilledHole(zone, hole);
    if (Contains(pocket, site.home.head<2>())) {
      return internal::Difference(BoxAround(site), {pocket});
    }
    parted.push_back(pocket);
  }
  return parted;
}

bool MeetsAny(const Polygon& outline, const std::vector<Polygon>& areas) {
  return std::ranges::any_of(
      areas, [&](const Polygon& area) { return internal::InteriorsMeet(outline, area); });
}

}  // namespace

void CloseOff(Site& site) {
  std::vector<Polygon> parted;
  for (const Polygon& zone : site.no_fly) {
    std::ranges::move(PartedBy(zone, site), std::back_inserter(parted));
  }
  if (parted.empty()) return;
  for (const Polygon& part : internal::Union(parted)) {
    std::ranges::move(internal::Difference(part, site.no_fly), std::back_inserter(site.closed_off));
  }
  std::set<std::string> all, buildings;
  for (const Footprint& footprint : site.footprints) {
    if (!footprint.in_area || footprint.is_obstacle) continue;
    all.insert(footprint.building);
    if (MeetsAny(footprint.outline, site.closed_off)) buildings.insert(footprint.building);
  }
  if (buildings.empty()) return;
  if (buildings == all) {
    throw Error(ErrorKind::kBadInput, "no-fly polygons leave no way from home to any building",
                "give another home point (--home), or correct the no-fly polygons");
  }
  site.warnings.push_back(fmt::format(
      "no-fly polygons leave no way from home to {}: nothing is planned there. Another home "
      "(--home), or flights of their own, may capture them",
      fmt::join(buildings, ", ")));
}

}  // namespace stucco::plan
