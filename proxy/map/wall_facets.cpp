// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/map/wall_facets.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <utility>

#include "proxy/facets/facets.h"
#include "proxy/facets/plane_view.h"

namespace stucco {
namespace {

FacetClass ClassOf(ExtrudedFace::Kind kind) {
  switch (kind) {
    case ExtrudedFace::Kind::kWall:
      return FacetClass::kWall;
    case ExtrudedFace::Kind::kRoof:
      return FacetClass::kRoof;
    case ExtrudedFace::Kind::kFloor:
      return FacetClass::kGround;
    case ExtrudedFace::Kind::kUnderside:
      return FacetClass::kOuterFloor;
  }
  return FacetClass::kGround;
}

bool LooksDown(ExtrudedFace::Kind kind) {
  return kind == ExtrudedFace::Kind::kFloor || kind == ExtrudedFace::Kind::kUnderside;
}

PlaneRole RoleOf(const ExtrudedFace& face) {
  constexpr double kLevel = 0.998;  // within 4 degrees
  if (face.kind == ExtrudedFace::Kind::kWall) return PlaneRole::kWall;
  if (LooksDown(face.kind)) return PlaneRole::kCeiling;
  return face.normal.z() > kLevel ? PlaneRole::kHorizontal : PlaneRole::kSlope;
}

// The fitted edges that a wall stands on, those it has most of first.
std::vector<const FittedEdge*> EdgesBelow(const Segment2d& foot, const FittedBuilding& building) {
  constexpr double kOn_m = 0.005;
  constexpr double kLeast_m = 0.05;
  std::vector<std::pair<double, const FittedEdge*>> found;
  const Eigen::Vector2d along = (foot.b - foot.a).normalized();
  for (const FittedEdge& edge : building.edges) {
    const Eigen::Vector2d theirs = (edge.line.b - edge.line.a).normalized();
    const double off = std::max(std::abs(Cross(along, edge.line.a - foot.a)),
                                std::abs(Cross(along, edge.line.b - foot.a)));
    if (!(along.dot(theirs) > 0) || off > kOn_m) continue;
    const double from = std::max(0.0, along.dot(edge.line.a - foot.a));
    const double to = std::min((foot.b - foot.a).norm(), along.dot(edge.line.b - foot.a));
    if (to - from > kLeast_m) found.emplace_back(to - from, &edge);
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<const FittedEdge*> edges;
  edges.reserve(found.size());
  for (const auto& [shared, edge] : found) edges.push_back(edge);
  return edges;
}

// The samples on a face's plane, as the plane that shows it.
Plane SupportOf(const ExtrudedFace& face, const Samples& near, const Tolerances& tolerances,
                double normal_angle_deg) {
  Plane plane{.normal = face.normal, .offset = face.offset, .points = {}, .role = RoleOf(face)};
  const double least = std::cos(normal_angle_deg * std::numbers::pi / 180);
  for (size_t i = 0; i < near.size(); ++i) {
    if (std::abs(plane.DistanceTo(near.positions[i])) > tolerances.epsilon) continue;
    if (near.normals[i].dot(plane.normal) >= least) plane.points.push_back(static_cast<int>(i));
  }
  return plane;
}

Facet MeasuredFacet(const ExtrudedFace& face, const Samples& near, const Tolerances& tolerances,
                    double normal_angle_deg) {
  const Plane plane = SupportOf(face, near, tolerances, normal_angle_deg);
  PlaneView view;
  view.plane = &plane;
  const PlaneFrame frame =
      FrameOf(plane, Eigen::Vector3d::UnitZ(), Eigen::Vector3d::UnitX(), face.outer.front());
  view.raster.frame = frame;
  Polygon polygon;
  const auto flat = [&](const std::vector<Eigen::Vector3d>& ring) {
    Ring points;
    points.reserve(ring.size());
    for (const auto& p : ring) points.push_back(frame.ToPlane(p));
    return points;
  };
  polygon.rings.push_back(flat(face.outer));
  for (const auto& hole : face.holes) polygon.rings.push_back(flat(hole));
  const Eigen::AlignedBox2d box = BoundsOf(polygon);
  if (!LooksDown(face.kind) && !plane.points.empty()) {
    // The grid must reach over the whole facet: what lies beside the samples is not seen.
    Eigen::AlignedBox2d seen;
    for (const int i : plane.points) seen.extend(frame.ToPlane(near.positions[i]));
    const double margin =
        std::max({0.0, (seen.min() - box.min()).maxCoeff(), (box.max() - seen.max()).maxCoeff()});
    const double cell = std::max(2.0 * tolerances.spacing, tolerances.level_of_detail / 3);
    view.raster = RasteriseHits(near, plane, frame, cell, margin + cell);
    view.evidence = Classify(view.raster, tolerances.fill_gap, 0);
  }
  Facet facet = MakeFacet(near, view, polygon);
  facet.outer = face.outer;
  facet.holes = face.holes;
  facet.facet_class = ClassOf(face.kind);
  return facet;
}

// The plan's facades that a wall is part of, and whether its place is only the map's.
void NameWall(const ExtrudedFace& face, const FittedBuilding& building, Facet& facet) {
  const auto edges = EdgesBelow(face.foot, building);
  std::set<std::string> known;
  for (const FittedEdge* edge : edges) {
    for (const std::string& id : edge->facades) {
      if (known.insert(id).second) facet.planned_facades.push_back(id);
    }
  }
  const bool fitted =
      std::ranges::any_of(edges, [](const FittedEdge* edge) { return edge->fitted; });
  if (!edges.empty() && !fitted) facet.source = "footprint";
}

}  // namespace

std::vector<Facet> FacetsOf(const std::vector<ExtrudedFace>& faces, const FittedBuilding& building,
                            const Samples& near, const Tolerances& tolerances,
                            double normal_angle_deg) {
  std::vector<Facet> facets;
  for (const ExtrudedFace& face : faces) {
    Facet facet = MeasuredFacet(face, near, tolerances, normal_angle_deg);
    facet.source = facet.seen > 0 ? "planes" : "extruded";
    if (face.kind == ExtrudedFace::Kind::kWall) NameWall(face, building, facet);
    if (face.kind == ExtrudedFace::Kind::kFloor) facet.source = "extruded";
    if (face.kind == ExtrudedFace::Kind::kUnderside) facet.source = "footprint";
    facets.push_back(std::move(facet));
  }
  return facets;
}

std::vector<Facet> Turned(std::vector<Facet> facets, const Eigen::Matrix3d& rotation) {
  for (Facet& facet : facets) {
    facet.normal = (rotation * facet.normal).normalized();
    for (auto& p : facet.outer) p = rotation * p;
    for (auto& hole : facet.holes) {
      for (auto& p : hole) p = rotation * p;
    }
  }
  return facets;
}

}  // namespace stucco
