// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulate/city/pitched_roof.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_2.h>
#include <CGAL/Polygon_with_holes_2.h>
#include <CGAL/create_straight_skeleton_from_polygon_with_holes_2.h>

#include <algorithm>
#include <cmath>

#include "simulate/city/footprints.h"
#include "survey/error.h"

namespace stucco::simulate {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

// Nodes of the skeleton nearer than this are one in which several events fall together.
constexpr double kSame_m = 1e-6;

using Edges = std::vector<OutlineEdge>;

PitchedRoof Eaves(const Edges& edges) {
  PitchedRoof roof;
  for (const OutlineEdge& edge : edges) roof.vertices.emplace_back(edge.a.x(), edge.a.y(), 0);
  roof.apex_of.assign(edges.size(), -1);
  return roof;
}

CGAL::Polygon_with_holes_2<Kernel> ToCgal(const Polygon& outline) {
  const auto ring = [](const Ring& corners) {
    CGAL::Polygon_2<Kernel> polygon;
    for (const Vector2d& corner : corners) polygon.push_back({corner.x(), corner.y()});
    return polygon;
  };
  CGAL::Polygon_with_holes_2<Kernel> polygon(ring(outline.rings.at(0)));
  for (size_t i = 1; i < outline.rings.size(); ++i) polygon.add_hole(ring(outline.rings[i]));
  return polygon;
}

int FindOrAdd(const Vector3d& point, size_t first, std::vector<Vector3d>& vertices) {
  for (size_t i = first; i < vertices.size(); ++i) {
    if ((vertices[i] - point).head<2>().norm() < kSame_m) return static_cast<int>(i);
  }
  vertices.push_back(point);
  return static_cast<int>(vertices.size()) - 1;
}

PitchedRoof HippedRoof(const Polygon& outline, const Edges& edges, double slope) {
  const auto skeleton = CGAL::create_interior_straight_skeleton_2(ToCgal(outline), Kernel());
  if (!skeleton) throw Error(ErrorKind::kStageFailed, "a footprint has no straight skeleton");
  PitchedRoof roof = Eaves(edges);
  const size_t ridges = roof.vertices.size();
  for (auto face = skeleton->faces_begin(); face != skeleton->faces_end(); ++face) {
    PitchedRoof::Face slope_face;
    const auto contour = face->halfedge();  // CGAL starts each face at its edge of the outline
    const auto first = contour->opposite()->vertex()->point();
    const auto at = std::find_if(edges.begin(), edges.end(), [&](const OutlineEdge& edge) {
      return edge.a == Vector2d(first.x(), first.y());
    });
    slope_face.edge = static_cast<int>(at - edges.begin());
    auto step = contour;
    do {
      const auto& vertex = *step->vertex();
      const Vector3d point(vertex.point().x(), vertex.point().y(), slope * vertex.time());
      const int index = vertex.is_contour() ? FindOrAdd(point, 0, roof.vertices)
                                            : FindOrAdd(point, ridges, roof.vertices);
      if (slope_face.corners.empty() || slope_face.corners.back() != index) {
        slope_face.corners.push_back(index);
      }
      step = step->next();
    } while (step != contour);
    if (slope_face.corners.front() == slope_face.corners.back()) slope_face.corners.pop_back();
    roof.faces.push_back(std::move(slope_face));
  }
  std::sort(roof.faces.begin(), roof.faces.end(),
            [](const auto& a, const auto& b) { return a.edge < b.edge; });
  return roof;
}

// Whether an edge ends a wing: its neighbours run parallel, at right angles to it.
bool EndsWing(const Edges& edges, int edge) {
  constexpr double kParallel = 1e-6;
  const Vector2d before = edges[edges[edge].before].along();
  const Vector2d after = edges[edges[edge].after].along();
  return (before + after).norm() < kParallel &&
         std::abs(before.dot(edges[edge].along())) < kParallel;
}

// The tip of the hip over an edge if it can become a gable, else -1.
int TipOf(const PitchedRoof& roof, const Edges& edges, const PitchedRoof::Face& face) {
  if (face.corners.size() != 3 || !EndsWing(edges, face.edge)) return -1;
  const int tip = *std::max_element(face.corners.begin(), face.corners.end());
  const auto meets = [&](const PitchedRoof::Face& other) {
    return std::find(other.corners.begin(), other.corners.end(), tip) != other.corners.end();
  };
  return std::count_if(roof.faces.begin(), roof.faces.end(), meets) == 3 ? tip : -1;
}

void OpenGables(const Edges& edges, bool all, const std::vector<bool>& gables, PitchedRoof& roof) {
  for (const PitchedRoof::Face& face : roof.faces) {
    const bool wanted =
        all || (static_cast<size_t>(face.edge) < gables.size() && gables[face.edge]);
    const int tip = wanted ? TipOf(roof, edges, face) : -1;
    if (tip < 0) continue;
    roof.apex_of[face.edge] = tip;
    roof.vertices[tip].head<2>() = (edges[face.edge].a + edges[face.edge].b) / 2;
  }
  std::erase_if(roof.faces, [&](const auto& face) { return roof.apex_of[face.edge] >= 0; });
}

// Over a rectangle, with gables over `edge` and the one opposite.
PitchedRoof GabledRectangle(const Edges& edges, int edge, double slope) {
  PitchedRoof roof = Eaves(edges);
  const double rise = slope * (edges[edge].b - edges[edge].a).norm() / 2;
  const int opposite = (edge + 2) % 4;
  for (const int gable : {edge, opposite}) {
    const Vector2d middle = (edges[gable].a + edges[gable].b) / 2;
    roof.apex_of[gable] = static_cast<int>(roof.vertices.size());
    roof.vertices.emplace_back(middle.x(), middle.y(), rise);
  }
  const int right = (edge + 1) % 4;
  const int left = (edge + 3) % 4;
  roof.faces.push_back({right, {right, opposite, roof.apex_of[opposite], roof.apex_of[edge]}});
  roof.faces.push_back({left, {left, edge, roof.apex_of[edge], roof.apex_of[opposite]}});
  return roof;
}

bool IsRectangle(const Polygon& outline, const Edges& edges) {
  return outline.rings.size() == 1 && edges.size() == 4 && EndsWing(edges, 0) && EndsWing(edges, 1);
}

}  // namespace

PitchedRoof MakePitchedRoof(const Polygon& outline, RoofShape shape, double slope,
                            const std::vector<bool>& gables) {
  const Edges edges = EdgesOf(outline);
  const auto wanted = std::find(gables.begin(), gables.end(), true);
  const bool named = wanted != gables.end();
  if (IsRectangle(outline, edges) && (named || shape == RoofShape::kGabled)) {
    const auto length = [&](int i) { return (edges[i].b - edges[i].a).norm(); };
    const int shorter = length(0) <= length(1) ? 0 : 1;
    return GabledRectangle(edges, named ? static_cast<int>(wanted - gables.begin()) % 4 : shorter,
                           slope);
  }
  PitchedRoof roof = HippedRoof(outline, edges, slope);
  OpenGables(edges, shape == RoofShape::kGabled, gables, roof);
  return roof;
}

}  // namespace stucco::simulate
