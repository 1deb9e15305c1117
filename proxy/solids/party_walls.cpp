// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/solids/party_walls.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_2.h>
#include <CGAL/intersections.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <boost/variant/get.hpp>
#include <cmath>
#include <optional>

#include "proxy/planes/plane.h"
#include "site/box_grid.h"
#include "survey/geometry2d.h"
#include "survey/triangulate.h"

namespace stucco {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Triangle = Kernel::Triangle_2;

constexpr double kGap_m = 0.3;
constexpr double kFaceToFace = -0.9998;  // cosine: a degree

Eigen::AlignedBox3d BoundsOf(const Facet& facet) {
  Eigen::AlignedBox3d box;
  for (const auto& p : facet.outer) box.extend(p);
  return box;
}

Eigen::AlignedBox3d BoundsOf(const Building& building) {
  Eigen::AlignedBox3d box;
  for (const Facet& facet : building.facets) box.extend(BoundsOf(facet));
  return box;
}

std::vector<Triangle> Flattened(const Facet& facet, const PlaneFrame& frame) {
  const FacetTriangles split = TriangulateFacet(facet);
  std::vector<Triangle> flat;
  flat.reserve(split.triangles.size());
  for (const auto& corners : split.triangles) {
    std::array<Kernel::Point_2, 3> p;
    for (size_t i = 0; i < 3; ++i) {
      const Eigen::Vector2d at = frame.ToPlane(split.vertices[corners[i]]);
      p[i] = {at.x(), at.y()};
    }
    const Triangle triangle(p[0], p[1], p[2]);
    if (!triangle.is_degenerate()) flat.push_back(triangle);
  }
  return flat;
}

double SharedArea(const Triangle& a, const Triangle& b) {
  const auto shared = CGAL::intersection(a, b);
  if (!shared) return 0;
  if (const auto* triangle = boost::get<Triangle>(&*shared)) return std::abs(triangle->area());
  if (const auto* points = boost::get<std::vector<Kernel::Point_2>>(&*shared)) {
    return std::abs(CGAL::Polygon_2<Kernel>(points->begin(), points->end()).area());
  }
  return 0;
}

// Metres from the wall's plane to the other's, where they face each other; infinite elsewhere.
double GapBetween(const Facet& wall, const Facet& other) {
  if (wall.normal.dot(other.normal) > kFaceToFace) return INFINITY;
  double sum = 0;
  for (const auto& p : other.outer) sum += wall.normal.dot(p) - wall.offset;
  return std::abs(sum / static_cast<double>(other.outer.size()));
}

double SharedArea(const Facet& wall, const Facet& other) {
  const Eigen::Vector3d u = AnyPerpendicular(wall.normal);
  const PlaneFrame frame{.origin = wall.outer.front(), .u = u, .v = wall.normal.cross(u)};
  double area = 0;
  const std::vector<Triangle> others = Flattened(other, frame);
  for (const Triangle& triangle : Flattened(wall, frame)) {
    for (const Triangle& against : others) area += SharedArea(triangle, against);
  }
  return area;
}

void AddParty(const std::vector<Facet>& neighbours, Facet& wall) {
  Eigen::AlignedBox3d box = BoundsOf(wall);
  box.min().array() -= kGap_m;
  box.max().array() += kGap_m;
  for (const Facet& other : neighbours) {
    if (other.facet_class != FacetClass::kWall || !box.intersects(BoundsOf(other))) continue;
    if (GapBetween(wall, other) > kGap_m) continue;
    wall.party = std::min(1.0, wall.party + SharedArea(wall, other) / wall.area);
  }
}

// Where a triangle of the ground meets the plane next to a wall, `beside` in front of it, in the
// wall's frame.
std::optional<Segment2d> CutBeside(const std::array<Eigen::Vector3d, 3>& triangle,
                                   const Facet& wall, double beside, const PlaneFrame& frame) {
  std::array<Eigen::Vector2d, 2> ends;
  size_t count = 0;
  for (size_t i = 0; i < 3 && count < 2; ++i) {
    const Eigen::Vector3d& a = triangle[i];
    const Eigen::Vector3d& b = triangle[(i + 1) % 3];
    const double from = wall.normal.dot(a) - wall.offset - beside;
    const double to = wall.normal.dot(b) - wall.offset - beside;
    if ((from < 0) == (to < 0)) continue;
    ends[count++] = frame.ToPlane(a + (b - a) * (from / (from - to)));
  }
  if (count < 2) return std::nullopt;
  return Segment2d{ends[0], ends[1]};
}

using FlatBoxes = std::vector<Eigen::AlignedBox2d>;
using PlanFromWorld = Eigen::Matrix<double, 2, 3>;

// Of a box seen from above.
Eigen::AlignedBox2d Flattened(const Eigen::AlignedBox3d& box,
                              const PlanFromWorld& plan_from_world) {
  const Eigen::Vector2d middle = plan_from_world * box.center();
  const Eigen::Vector2d half = plan_from_world.cwiseAbs() * box.sizes() / 2;
  return {middle - half, middle + half};
}

// With about as many cells as boxes, whatever the unit of the frame.
BoxGrid GridOf(const FlatBoxes& boxes) {
  Eigen::AlignedBox2d bounds;
  for (const Eigen::AlignedBox2d& box : boxes) bounds.extend(box);
  const double size = bounds.isEmpty() ? 1 : bounds.sizes().maxCoeff();
  constexpr double kLeast = 1e-9;
  return {boxes, std::max(kLeast, size / std::sqrt(1 + static_cast<double>(boxes.size())))};
}

// The ground as triangles, each with its bounds.
class GroundTriangles {
 public:
  struct Triangle {
    std::array<Eigen::Vector3d, 3> corners;
    Eigen::AlignedBox3d box;
  };

  GroundTriangles(const std::vector<Building>& buildings, const PlanFromWorld& plan_from_world)
      : plan_from_world_(plan_from_world),
        triangles_(AllOf(buildings)),
        grid_(GridOf(FlatBoxesOf(triangles_, plan_from_world))) {}

  template <typename Visit>
  void ForEachIn(const Eigen::AlignedBox3d& box, const Visit& visit) const {
    for (const int i : grid_.Touching(Flattened(box, plan_from_world_))) {
      if (box.intersects(triangles_[i].box)) visit(triangles_[i].corners);
    }
  }

 private:
  static std::vector<Triangle> AllOf(const std::vector<Building>& buildings) {
    std::vector<Triangle> triangles;
    for (const Building& building : buildings) {
      if (building.id != "G0") continue;
      for (const Facet& facet : building.facets) Add(facet, triangles);
    }
    return triangles;
  }

  static void Add(const Facet& facet, std::vector<Triangle>& triangles) {
    const FacetTriangles split = TriangulateFacet(facet);
    for (const auto& corners : split.triangles) {
      Triangle& triangle = triangles.emplace_back();
      for (size_t i = 0; i < 3; ++i) {
        triangle.corners[i] = split.vertices[corners[i]];
        triangle.box.extend(triangle.corners[i]);
      }
    }
  }

  static FlatBoxes FlatBoxesOf(const std::vector<Triangle>& triangles,
                               const PlanFromWorld& plan_from_world) {
    FlatBoxes boxes;
    boxes.reserve(triangles.size());
    for (const Triangle& triangle : triangles) {
      boxes.push_back(Flattened(triangle.box, plan_from_world));
    }
    return boxes;
  }

  PlanFromWorld plan_from_world_;
  std::vector<Triangle> triangles_;
  BoxGrid grid_;
};

void AddBuried(const GroundTriangles& ground, const Eigen::Vector3d& up, Facet& wall) {
  constexpr double kBeside_m = 0.1;
  constexpr double kDeepest_m = 10;
  const Eigen::Vector3d u = up.cross(wall.normal).normalized();
  const PlaneFrame frame{.origin = wall.outer.front(), .u = u, .v = wall.normal.cross(u)};
  Eigen::AlignedBox3d reach = BoundsOf(wall);
  for (const auto& p : wall.outer) reach.extend(p + kDeepest_m * up);
  reach.min().array() -= 2 * kBeside_m;
  reach.max().array() += 2 * kBeside_m;
  double lowest = 0;
  for (const auto& p : wall.outer) lowest = std::min(lowest, frame.ToPlane(p).y() - 1);
  const std::vector<Triangle> pieces = Flattened(wall, frame);
  double area = 0;
  ground.ForEachIn(reach, [&](const std::array<Eigen::Vector3d, 3>& corners) {
    const auto cut = CutBeside(corners, wall, kBeside_m, frame);
    if (!cut) return;
    const double bottom = std::min({lowest, cut->a.y() - 1, cut->b.y() - 1});
    const Kernel::Point_2 a(cut->a.x(), cut->a.y()), below_a(a.x(), bottom);
    const Kernel::Point_2 b(cut->b.x(), cut->b.y()), below_b(b.x(), bottom);
    for (const Triangle& half : {Triangle(a, below_a, below_b), Triangle(a, below_b, b)}) {
      if (half.is_degenerate()) continue;
      for (const Triangle& piece : pieces) area += SharedArea(piece, half);
    }
  });
  wall.party = std::min(1.0, wall.party + area / wall.area);
}

// The floor that closes a solid, as opposed to the underside of a part that stands on others.
bool IsFloor(const Facet& facet, const Building& building, const Eigen::AlignedBox3d& bounds,
             const Eigen::Vector3d& up) {
  constexpr double kStep_m = 0.5;
  if (facet.facet_class != FacetClass::kGround || building.id == "G0") return false;
  const double lowest = up.dot(bounds.center()) - up.cwiseAbs().dot(bounds.sizes()) / 2;
  return std::ranges::all_of(facet.outer,
                             [&](const auto& corner) { return up.dot(corner) < lowest + kStep_m; });
}

}  // namespace

void MeasureParty(const Eigen::Vector3d& up, std::vector<Building>& buildings) {
  std::vector<Eigen::AlignedBox3d> boxes;
  boxes.reserve(buildings.size());
  for (const Building& building : buildings) boxes.push_back(BoundsOf(building));
  const PlanFromWorld plan_from_world =
      Eigen::Quaterniond::FromTwoVectors(up, Eigen::Vector3d::UnitZ())
          .toRotationMatrix()
          .topRows<2>();
  const GroundTriangles ground(buildings, plan_from_world);
  FlatBoxes flat;
  flat.reserve(boxes.size());
  for (const Eigen::AlignedBox3d& box : boxes) flat.push_back(Flattened(box, plan_from_world));
  const BoxGrid grid = GridOf(flat);
  for (size_t a = 0; a < buildings.size(); ++a) {
    Eigen::AlignedBox3d reach = boxes[a];
    reach.min().array() -= kGap_m;
    reach.max().array() += kGap_m;
    for (Facet& facet : buildings[a].facets) {
      facet.party = IsFloor(facet, buildings[a], boxes[a], up) ? 1 : 0;
    }
    for (const int near : grid.Touching(Flattened(reach, plan_from_world))) {
      const auto b = static_cast<size_t>(near);
      if (a == b || !reach.intersects(boxes[b])) continue;
      for (Facet& facet : buildings[a].facets) {
        const bool is_wall = facet.facet_class == FacetClass::kWall && facet.area > 0;
        if (is_wall) AddParty(buildings[b].facets, facet);
      }
    }
    for (Facet& facet : buildings[a].facets) {
      const bool is_wall = facet.facet_class == FacetClass::kWall && facet.area > 0;
      if (is_wall) AddBuried(ground, up, facet);
    }
  }
}

}  // namespace stucco
