// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/map/outlines.h"

#include <algorithm>
#include <cassert>
#include <limits>
#include <map>

#include "site/site_of_plan.h"
#include "survey/plan_frame.h"

namespace stucco {
namespace {

// Parts whose underside is this far above the building's foot stand on others.
constexpr double kRaisedFoot_m = 1;

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
    Polygon& part = (is_raised ? building.raised : building.parts).emplace_back();
    for (const Ring& ring : footprint.outline.rings) {
      Ring& moved = part.rings.emplace_back();
      for (const Eigen::Vector2d& corner : ring) moved.push_back(to_survey(corner));
    }
  }
  return map;
}

MapBuilding Moved(const MapBuilding& building, const Eigen::Isometry2d& motion) {
  MapBuilding moved = building;
  for (auto* polygons : {&moved.parts, &moved.raised}) {
    for (Polygon& part : *polygons) {
      for (Ring& ring : part.rings) {
        for (Eigen::Vector2d& corner : ring) corner = motion * corner;
      }
    }
  }
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
