// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/proxy/map_scene.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "proxy/abstract.h"
#include "proxy/solids/closed_check.h"
#include "survey/triangulate.h"

namespace stucco::test {

Ring Rectangle(double x0, double y0, double x1, double y1) {
  return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
}

Ring Court(double x0, double y0, double x1, double y1) {
  Ring ring = Rectangle(x0, y0, x1, y1);
  std::reverse(ring.begin(), ring.end());
  return ring;
}

Plan PlanOf(const std::vector<MapEntry>& entries) {
  Plan plan;
  plan.origin = {.latitude_deg = 50, .longitude_deg = 14};
  for (const MapEntry& entry : entries) {
    plan.footprints.push_back(
        {.building = entry.id, .rings_m = entry.rings, .z_m = {entry.foot, entry.top}});
    int number = 0;
    for (const Ring& ring : entry.rings) {
      for (size_t i = 0; i < ring.size(); ++i) {
        PlannedFacade& facade = plan.facades.emplace_back();
        facade.id = fmt::format("{}/F{:02}", entry.id, number++);
        facade.a_m = ring[i];
        facade.b_m = ring[(i + 1) % ring.size()];
        facade.z_m = {entry.foot, entry.top};
        facade.top_known = true;
      }
    }
  }
  return plan;
}

Georef MapGeoref() {
  Georef georef;
  georef.frame = "enu";
  georef.origin_latitude_deg = 50;
  georef.origin_longitude_deg = 14;
  georef.up = Eigen::Vector3d::UnitZ();
  georef.metric = true;
  georef.source = "rtk";
  return georef;
}

std::vector<MapEntry> Displaced(std::vector<MapEntry> entries, double turn_deg,
                                const Eigen::Vector2d& shift) {
  const Eigen::Rotation2Dd turn(turn_deg * std::numbers::pi / 180);
  for (MapEntry& entry : entries) {
    for (Ring& ring : entry.rings) {
      for (Eigen::Vector2d& corner : ring) corner = turn * corner + shift;
    }
  }
  return entries;
}

House FlatHouse(const Ring& ring, double height) {
  House house;
  TruePolygon roof{.name = "roof", .ring = {}};
  for (size_t i = 0; i < ring.size(); ++i) {
    const Eigen::Vector2d a = ring[i], b = ring[(i + 1) % ring.size()];
    house.polygons.push_back(
        {"wall",
         {{a.x(), a.y(), 0}, {b.x(), b.y(), 0}, {b.x(), b.y(), height}, {a.x(), a.y(), height}}});
    roof.ring.emplace_back(a.x(), a.y(), height);
  }
  house.polygons.push_back(roof);
  return house;
}

House HipHouse(double length, double width, double height) {
  const double x = length / 2, y = width / 2, r = x - y, top = height + y;
  House house = FlatHouse(Rectangle(-x, -y, x, y), height);
  house.polygons.pop_back();
  const double h = height;
  house.polygons.push_back({"south roof", {{-x, -y, h}, {x, -y, h}, {r, 0, top}, {-r, 0, top}}});
  house.polygons.push_back({"north roof", {{x, y, h}, {-x, y, h}, {-r, 0, top}, {r, 0, top}}});
  house.polygons.push_back({"east roof", {{x, -y, h}, {x, y, h}, {r, 0, top}}});
  house.polygons.push_back({"west roof", {{-x, y, h}, {-x, -y, h}, {-r, 0, top}}});
  return house;
}

Ring HipLOutline() {
  return {{0, 0}, {12, 0}, {12, 6}, {6, 6}, {6, 14}, {0, 14}};
}

House HipLHouse(double height) {
  House house = FlatHouse(HipLOutline(), height);
  house.polygons.pop_back();
  const double h = height, top = height + 3;
  house.polygons.push_back({"south roof", {{0, 0, h}, {12, 0, h}, {9, 3, top}, {3, 3, top}}});
  house.polygons.push_back({"west roof", {{0, 14, h}, {0, 0, h}, {3, 3, top}, {3, 11, top}}});
  house.polygons.push_back({"east hip", {{12, 0, h}, {12, 6, h}, {9, 3, top}}});
  house.polygons.push_back({"north hip", {{6, 14, h}, {0, 14, h}, {3, 11, top}}});
  house.polygons.push_back({"north roof", {{12, 6, h}, {6, 6, h}, {3, 3, top}, {9, 3, top}}});
  house.polygons.push_back({"east roof", {{6, 6, h}, {6, 14, h}, {3, 11, top}, {3, 3, top}}});
  return house;
}

MadeModel MakeModel(const Captured& captured, const std::vector<MapEntry>& map,
                    const ProxyOptions& options) {
  MadeModel made;
  ProxyInput input = InputOf(captured, MapGeoref());
  input.plan = PlanOf(map);
  made.proxy = AbstractCloud(input, options, 2, made.findings);
  EXPECT_EQ(FindProblem(made.proxy), std::nullopt);
  return made;
}

const Building& ClosedIn(const MadeModel& made, const std::string& id) {
  static const Building kNone;
  const Building* building = Find(made.proxy, id);
  EXPECT_NE(building, nullptr) << id;
  if (building == nullptr) return kNone;
  EXPECT_TRUE(building->watertight);
  EXPECT_EQ(FindOpening(building->facets), std::nullopt) << id;
  EXPECT_EQ(building->source, "map");
  return *building;
}

std::vector<const Facet*> OfClass(const Building& building, FacetClass facet_class) {
  std::vector<const Facet*> facets;
  for (const Facet& facet : building.facets) {
    if (facet.facet_class == facet_class) facets.push_back(&facet);
  }
  return facets;
}

double TopOf(const Facet& facet) {
  double top = -1e9;
  for (const auto& p : facet.outer) top = std::max(top, p.z());
  return top;
}

double VolumeOf(const Building& building) {
  const TriangleSoup soup = TriangulateFacets(building.facets);
  double volume = 0;
  for (const auto& t : soup.triangles) {
    volume += soup.points[t[0]].dot(soup.points[t[1]].cross(soup.points[t[2]])) / 6;
  }
  return volume;
}

double AreaOf(const Building& building, FacetClass facet_class) {
  double area = 0;
  for (const Facet& facet : building.facets) {
    if (facet.facet_class == facet_class) area += facet.area;
  }
  return area;
}

const Building* Find(const Proxy& proxy, const std::string& id) {
  const auto found = std::ranges::find(proxy.buildings, id, &Building::id);
  return found == proxy.buildings.end() ? nullptr : &*found;
}

}  // namespace stucco::test
