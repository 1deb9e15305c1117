// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulate/city/roof_mesh.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "simulate/city/footprints.h"
#include "simulate/random.h"
#include "survey/geometry2d.h"

namespace stucco::simulate {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kVerge_m = 0.22;    // overhang over a gable
constexpr double kRafters_m = 0.16;  // thickness of a pitched roof
constexpr double kParapet_m = 0.25;  // thickness

bool IsPitched(const House& house) {
  return house.roof != RoofShape::kFlat;
}

// By edge: the top of its gable as a vertex of the solid, -1 for eaves.
std::vector<int> Gables(const House& house, const Solid& solid) {
  std::vector<int> apex(house.party.size(), -1);
  for (const Solid::Face& face : solid.faces) {
    if (face.facet_class == FacetClass::kWall && face.outer.size() == 5) {
      apex[face.edge] = face.outer[3];
    }
  }
  return apex;
}

// By edge.
std::vector<double> Overhangs(const House& house, const std::vector<int>& apex) {
  std::vector<double> overhangs;
  for (size_t i = 0; i < apex.size(); ++i) {
    overhangs.push_back(house.party[i] ? 0 : apex[i] >= 0 ? kVerge_m : house.overhang_m);
  }
  return overhangs;
}

Vector3d NormalOf(const Solid& solid, const Solid::Face& face) {
  return AreaVector(Corners(solid, face.outer)).normalized();
}

// Where the vertices of a pitched roof lie in the plan once its eaves stand out.
std::vector<Vector2d> OverhungPlan(const House& house, const Solid& solid) {
  const std::vector<int> apex = Gables(house, solid);
  const std::vector<double> overhangs = Overhangs(house, apex);
  std::vector<Vector2d> plan;
  for (const Vector3d& vertex : solid.vertices) plan.push_back(vertex.head<2>());
  auto eaves = plan.begin() + static_cast<int>(apex.size());  // above the corners of the floor
  auto overhang = overhangs.begin();
  for (const Ring& ring : house.outline.rings) {
    const auto next = overhang + static_cast<int>(ring.size());
    const Ring moved = Offset(ring, {overhang, next});
    eaves = std::copy(moved.begin(), moved.end(), eaves);
    overhang = next;
  }
  const std::vector<OutlineEdge> edges = EdgesOf(house.outline);
  for (size_t i = 0; i < edges.size(); ++i) {
    if (apex[i] >= 0) plan[apex[i]] += overhangs[i] * edges[i].outward();
  }
  return plan;
}

Loop OverhungFace(const House& house, const Solid& solid, const Solid::Face& face) {
  const std::vector<Vector2d> plan = OverhungPlan(house, solid);
  const Vector3d normal = NormalOf(solid, face);
  const double offset = normal.dot(solid.vertices[face.outer[0]]);
  Loop loop;
  for (const int corner : face.outer) {
    const Vector2d& p = plan[corner];
    loop.emplace_back(p.x(), p.y(), (offset - normal.head<2>().dot(p)) / normal.z());
  }
  return loop;
}

bool HasCorner(const Solid::Face& face, int corner) {
  return std::find(face.outer.begin(), face.outer.end(), corner) != face.outer.end();
}

// Does another face of the roof go on beyond the edge between two corners of a face?
bool IsShared(const Solid& solid, const Solid::Face& face, int from, int to) {
  return std::any_of(solid.faces.begin(), solid.faces.end(), [&](const Solid::Face& other) {
    return &other != &face && other.facet_class == FacetClass::kRoof && HasCorner(other, from) &&
           HasCorner(other, to);
  });
}

void AddPitchedEdges(const House& house, const Solid& solid, const Trim& trim, CityModel& model) {
  const Vector3d down(0, 0, -kRafters_m);
  for (const Solid::Face& face : solid.faces) {
    if (face.facet_class != FacetClass::kRoof) continue;
    const Loop loop = OverhungFace(house, solid, face);
    Loop under;
    for (auto corner = loop.rbegin(); corner != loop.rend(); ++corner) {
      under.push_back(*corner + down);
    }
    AddPolygon(TrimSheet(trim, -NormalOf(solid, face)), under, {}, model);
    // Fascias where no other face of the roof goes on.
    for (size_t i = 0; i < loop.size(); ++i) {
      const size_t next = (i + 1) % loop.size();
      if (IsShared(solid, face, face.outer[i], face.outer[next])) continue;
      AddTrim(trim, {loop[i] + down, loop[next] + down, loop[next], loop[i]}, model);
    }
  }
}

void AddParapet(const House& house, const Trim& trim, CityModel& model) {
  const double low = house.eaves_m();
  const double high = low + house.parapet_m;
  const auto at = [](const Vector2d& p, double z) { return Vector3d(p.x(), p.y(), z); };
  for (const Ring& ring : house.outline.rings) {
    const Ring inner = Offset(ring, std::vector<double>(ring.size(), -kParapet_m));
    for (size_t i = 0; i < ring.size(); ++i) {
      const size_t next = (i + 1) % ring.size();
      AddTrim(trim,
              {at(ring[i], high), at(ring[next], high), at(inner[next], high), at(inner[i], high)},
              model);
      AddTrim(trim,
              {at(inner[next], low), at(inner[i], low), at(inner[i], high), at(inner[next], high)},
              model);
    }
  }
}

struct Box {
  Vector2d middle, size;
  double low_m, high_m;
};

void AddBox(const Box& box, const Vector2d& along, const Trim& trim, CityModel& model) {
  const Vector2d x = box.size.x() / 2 * along;
  const Vector2d y = box.size.y() / 2 * Vector2d(-along.y(), along.x());
  AddPrism(trim, {box.middle - x - y, box.middle + x - y, box.middle + x + y, box.middle - x + y},
           box.low_m, box.high_m, model);
}

// z of a pitched roof at a place under it.
double RoofAt(const Solid& solid, const Vector2d& place) {
  double highest = solid.vertices[0].z();
  for (const Solid::Face& face : solid.faces) {
    if (face.facet_class != FacetClass::kRoof) continue;
    Ring ring;
    for (const int corner : face.outer) ring.push_back(solid.vertices[corner].head<2>());
    if (!Contains(ring, place)) continue;
    const Vector3d normal = NormalOf(solid, face);
    const Vector3d& corner = solid.vertices[face.outer[0]];
    const double fall = normal.head<2>().dot(place - corner.head<2>()) / normal.z();
    highest = std::max(highest, corner.z() - fall);
  }
  return highest;
}

Vector2d Along(const House& house) {
  const Ring& ring = house.outline.rings[0];
  return (ring[1] - ring[0]).normalized();
}

// A random place of the roof that is `from_edge` metres inside; false: none was found.
bool FindPlace(const House& house, double from_edge, Random& random, Vector2d& place) {
  Vector2d low = house.outline.rings[0][0];
  Vector2d high = low;
  for (const Vector2d& corner : house.outline.rings[0]) {
    low = low.cwiseMin(corner);
    high = high.cwiseMax(corner);
  }
  for (int i = 0; i < 40; ++i) {
    place = {random.Uniform(low.x(), high.x()), random.Uniform(low.y(), high.y())};
    if (Contains(house.outline, place) && DistanceToOutline(house.outline, place) > from_edge) {
      return true;
    }
  }
  return false;
}

}  // namespace

RoofSheet LayRoofSheet(const House& house, const Solid& solid, const Solid::Face& face) {
  RoofSheet result;
  Sheet& sheet = result.sheet;
  const Vector3d normal = NormalOf(solid, face);
  if (IsPitched(house)) {
    result.drawn = OverhungFace(house, solid, face);
    sheet.u = Vector3d::UnitZ().cross(normal).normalized();
  } else {
    result.drawn = Corners(solid, face.outer);
    sheet.u = (result.drawn[1] - result.drawn[0]).normalized();
  }
  sheet.v = sheet.u.cross(normal);
  Vector2d low = Vector2d::Constant(std::numeric_limits<double>::infinity());
  Vector2d high = -low;
  for (const Vector3d& corner : result.drawn) {
    const Vector2d at(corner.dot(sheet.u), corner.dot(sheet.v));
    low = low.cwiseMin(at);
    high = high.cwiseMax(at);
  }
  sheet.origin =
      low.x() * sheet.u + low.y() * sheet.v + normal.dot(solid.vertices[face.outer[0]]) * normal;
  sheet.width_m = high.x() - low.x();
  sheet.height_m = high.y() - low.y();
  return result;
}

void AddRoofEdges(const House& house, const Solid& solid, const Trim& trim, CityModel& model) {
  if (IsPitched(house)) {
    AddPitchedEdges(house, solid, trim, model);
  } else {
    AddParapet(house, trim, model);
  }
}

void AddRoofThings(const House& house, const Solid& solid, const Trim& trim, CityModel& model) {
  Random random(house.seed, 2);
  const Vector2d along = Along(house);
  double top = house.eaves_m();
  for (const Vector3d& vertex : solid.vertices) top = std::max(top, vertex.z());
  Vector2d place;
  if (IsPitched(house)) {
    const int chimneys = house.use == HouseUse::kHome ? 1 : random.Integer(1, 3);
    for (int i = 0; i < chimneys; ++i) {
      if (!FindPlace(house, 1.6, random, place)) continue;
      const double width = random.Uniform(0.5, 0.7);
      const double depth = random.Uniform(0.5, 1.1);
      const double high = std::min(RoofAt(solid, place) + 1.6, top + 0.8);
      AddBox({place, {width, depth}, house.eaves_m(), high}, along, trim, model);
    }
    return;
  }
  const double area = Area(house.outline);
  const double eaves = house.eaves_m();
  const bool large = house.use != HouseUse::kHome;
  if (large && FindPlace(house, 3, random, place)) {  // the head of the stairs
    const double height = random.Uniform(2.3, 2.7);
    const double depth = random.Uniform(2.6, 4);
    AddBox({place, {3.2, depth}, eaves, eaves + height}, along, trim, model);
  }
  const int boxes = std::min(12, static_cast<int>(area / 60) + 1);
  for (int i = 0; i < boxes; ++i) {
    if (!FindPlace(house, 1.2, random, place)) continue;
    const double side = random.Uniform(0.5, 1.4);
    const double height = random.Uniform(0.35, 1.1);
    const double depth = side * random.Uniform(0.7, 1.3);
    AddBox({place, {side, depth}, eaves, eaves + height}, along, trim, model);
  }
}

}  // namespace stucco::simulate
