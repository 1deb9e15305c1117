// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/map/outlines.h"

#include <algorithm>
#include <cassert>
#include <limits>
#include <map>
#include <utility>

#include "proxy/map/pinches.h"
#include "site/site_of_plan.h"
#include "survey/plan_frame.h"

namespace stucco {
namespace {

// Parts whose underside is this far above the building's foot stand on others.
constexpr double kRaisedFoot_m = 1;
// Of a building whose height neither the map nor the cloud knows.
constexpr double kTwoStoreys_m = 6;

// Whether next to nothing of a part lies above the building's others: counted on a grid.
bool Hangs(const Polygon& part, const MapBuilding& building) {
  constexpr double kStep_m = 0.5;
  constexpr double kMost = 0.05;
  const Eigen::AlignedBox2d box = BoundsOf(part);
  int inside = 0, above = 0;
  for (double y = box.min().y() + kStep_m / 2; y < box.max().y(); y += kStep_m) {
    for (double x = box.min().x() + kStep_m / 2; x < box.max().x(); x += kStep_m) {
      const Eigen::Vector2d p(x, y);
      if (!Contains(part, p)) continue;
      ++inside;
      above += std::ranges::any_of(building.parts,
                                   [&](const Polygon& other) { return Contains(other, p); });
    }
  }
  return inside > 0 && above <= kMost * inside;
}

// Raised parts below which nothing stands become parts of the building: of storeys above each other
// the lowest, whatever the map names first.
void AddHangingParts(MapBuilding& building) {
  std::ranges::stable_sort(building.raised, {}, &RaisedPart::underside_m);
  std::vector<RaisedPart> standing;
  for (RaisedPart& raised : building.raised) {
    if (Hangs(raised.outline, building)) {
      building.hanging.push_back({building.parts.size(), raised.underside_m});
      building.parts.push_back(std::move(raised.outline));
    } else {
      standing.push_back(std::move(raised));
    }
  }
  building.raised = std::move(standing);
}

// Once all parts of a building are known.
void MakeBuildable(const Plan& plan, MapBuilding& building) {
  AddHangingParts(building);
  OpenPinches(building.parts);
  // What the flight keeps clear of is no height to build by.
  const double height = building.z_m.to_m - building.z_m.from_m;
  if (!building.top_known && height > plan.safe_altitude_m - plan.d_min_m - kRaisedFoot_m) {
    building.z_m.to_m = building.z_m.from_m + std::min(height, kTwoStoreys_m);
  }
}

}  // namespace

Eigen::Matrix3d UprightFromWorld(const Eigen::Vector3d& up) {
  return Eigen::Quaterniond::FromTwoVectors(up, Eigen::Vector3d::UnitZ()).toRotationMatrix();
}

OutlineMap OutlinesOf(const Plan& plan, const Georef& georef, const Eigen::Vector3d& up) {
  assert(georef.frame == "enu");
  const Site site = SiteOfPlan(plan);
  const Eigen::Matrix3d upright_from_world = UprightFromWorld(up);
  const auto to_survey = [&](const Eigen::Vector2d& position) -> Eigen::Vector2d {
    const Eigen::Vector2d enu = EnuFromPlan(plan.origin, georef, position);
    return (upright_from_world * Eigen::Vector3d(enu.x(), enu.y(), 0)).head<2>();
  };
  OutlineMap map;
  for (const Facade& facade : site.facades) {
    Facade& moved = map.facades.emplace_back(facade);
    moved.a = to_survey(facade.a);
    moved.b = to_survey(facade.b);
  }
  std::map<std::string, double> foot;
  for (const Footprint& footprint : site.footprints) {
    const auto [entry, added] = foot.emplace(footprint.building, footprint.z_m.from_m);
    if (!added) entry->second = std::min(entry->second, footprint.z_m.from_m);
  }
  std::map<std::string, size_t> index;
  for (const Footprint& footprint : site.footprints) {
    if (footprint.is_obstacle || footprint.outline.rings.empty()) continue;
    const auto [entry, added] = index.emplace(footprint.building, map.buildings.size());
    if (added) {
      map.buildings.push_back(
          {.id = footprint.building, .parts = {}, .z_m = footprint.z_m, .top_known = true});
    }
    MapBuilding& building = map.buildings[entry->second];
    building.z_m.from_m = std::min(building.z_m.from_m, footprint.z_m.from_m);
    building.z_m.to_m = std::max(building.z_m.to_m, footprint.z_m.to_m);
    building.top_known = building.top_known && footprint.top_known;
    building.to_capture = building.to_capture || footprint.in_area;
    const bool is_raised = footprint.z_m.from_m > foot[footprint.building] + kRaisedFoot_m;
    Polygon part;
    for (const Ring& ring : footprint.outline.rings) {
      Ring& moved = part.rings.emplace_back();
      for (const Eigen::Vector2d& corner : ring) moved.push_back(to_survey(corner));
    }
    if (is_raised) {
      building.raised.push_back({std::move(part), footprint.z_m.from_m});
    } else {
      building.parts.push_back(std::move(part));
    }
  }
  for (MapBuilding& building : map.buildings) MakeBuildable(plan, building);
  return map;
}

MapBuilding Moved(const MapBuilding& building, const Eigen::Isometry2d& motion) {
  MapBuilding moved = building;
  const auto move = [&](Polygon& polygon) {
    for (Ring& ring : polygon.rings) {
      for (Eigen::Vector2d& corner : ring) corner = motion * corner;
    }
  };
  for (Polygon& part : moved.parts) move(part);
  for (RaisedPart& part : moved.raised) move(part.outline);
  return moved;
}

Eigen::AlignedBox2d BoundsOf(const MapBuilding& building, double margin) {
  Eigen::AlignedBox2d box;
  for (const Polygon& part : building.parts) box.extend(BoundsOf(part));
  if (box.isEmpty()) return box;
  return {box.min() - Eigen::Vector2d::Constant(margin),
          box.max() + Eigen::Vector2d::Constant(margin)};
}

double Area(const MapBuilding& building) {
  double area = 0;
  for (const Polygon& part : building.parts) area += Area(part);
  return area;
}

double DistanceTo(const MapBuilding& building, const Eigen::Vector2d& p) {
  double distance = std::numeric_limits<double>::infinity();
  for (const Polygon& part : building.parts) distance = std::min(distance, Distance(part, p));
  return distance;
}

double ToOutline(const MapBuilding& building, const Eigen::Vector2d& p) {
  double distance = std::numeric_limits<double>::infinity();
  for (const Polygon& part : building.parts) {
    for (const Ring& ring : part.rings) {
      for (size_t i = 0; i < ring.size(); ++i) {
        distance = std::min(distance, Distance(EdgeOf(ring, i), p));
      }
    }
  }
  return distance;
}

}  // namespace stucco
