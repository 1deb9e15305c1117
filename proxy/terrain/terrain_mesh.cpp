// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/terrain/terrain_mesh.h"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <vector>

#include "site/box_grid.h"

namespace stucco {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
// Of a face: its number, -1 outside of the terrain. Of a vertex: its height.
using FaceBase =
    CGAL::Triangulation_face_base_with_info_2<int, Kernel,
                                              CGAL::Constrained_triangulation_face_base_2<Kernel>>;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<double, Kernel>;
using Structure = CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>;
using Triangulation =
    CGAL::Constrained_Delaunay_triangulation_2<Kernel, Structure, CGAL::Exact_predicates_tag>;
using Face = Triangulation::Face_handle;

Eigen::Vector3d CornerOf(Face face, int i) {
  const auto& vertex = *face->vertex(i);
  return {vertex.point().x(), vertex.point().y(), vertex.info()};
}

// How far a point lies above a face.
double HeightOver(Face face, const Eigen::Vector3d& p) {
  const Eigen::Vector3d a = CornerOf(face, 0);
  const Eigen::Vector3d normal = (CornerOf(face, 1) - a).cross(CornerOf(face, 2) - a);
  return normal.dot(p - a) / normal.z();
}

std::vector<Eigen::AlignedBox2d> BoundsOfEach(std::span<const Polygon> polygons) {
  std::vector<Eigen::AlignedBox2d> bounds;
  bounds.reserve(polygons.size());
  for (const Polygon& polygon : polygons) bounds.push_back(BoundsOf(polygon));
  return bounds;
}

class TerrainMesher {
 public:
  TerrainMesher(const GroundHeights& ground, std::span<const Ring> outlines,
                std::span<const Polygon> footprints, double tolerance)
      : ground_(ground),
        outlines_(outlines),
        footprints_(footprints),
        tolerance_(tolerance),
        boxes_(BoundsOfEach(footprints), kGridCell_m) {
    for (const Ring& ring : outlines) AddRing(ring);
    for (const Polygon& footprint : footprints) {
      for (const Ring& ring : footprint.rings) AddRing(ring);
    }
    for (auto vertex : mesh_.finite_vertex_handles()) {
      vertex->info() = ground.HeightAt({vertex->point().x(), vertex->point().y()});
    }
    for (const GroundCell& cell : ground.cells()) {
      if (cell.samples > 0) cells_.push_back(&cell);
    }
  }

  // Takes cells until none is farther off than the tolerance.
  void Refine() {
    constexpr double kOfWorst = 0.4;  // what is much less far off may be near enough afterwards
    for (;;) {
      NumberFaces();
      std::vector<Candidate> worst(faces_);
      double most = 0;
      ForEachCell([&](Face face, const GroundCell& cell) {
        const double off = std::abs(HeightOver(face, cell.middle));
        if (off <= tolerance_ || IsAtEdge(face, cell.middle.head<2>())) return;
        most = std::max(most, off);
        if (off > worst[face->info()].off) worst[face->info()] = {&cell, off};
      });
      if (most == 0) return;
      for (const Candidate& candidate : worst) {
        if (candidate.cell == nullptr || candidate.off <= kOfWorst * most) continue;
        const Eigen::Vector3d& middle = candidate.cell->middle;
        mesh_.insert(Kernel::Point_2(middle.x(), middle.y()))->info() = middle.z();
      }
    }
  }

  std::vector<TerrainTriangle> Triangles() {
    NumberFaces();
    std::vector<TerrainTriangle> triangles(faces_);
    for (auto face : mesh_.finite_face_handles()) {
      if (face->info() < 0) continue;
      for (int i = 0; i < 3; ++i) triangles[face->info()].corners[i] = CornerOf(face, i);
    }
    ForEachCell([&](Face face, const GroundCell& cell) {
      TerrainTriangle& triangle = triangles[face->info()];
      const double off = HeightOver(face, cell.middle);
      ++triangle.cells;
      triangle.points += cell.points;
      triangle.squares += off * off;
    });
    return triangles;
  }

 private:
  static constexpr double kGridCell_m = 20;  // about as large as a house

  struct Candidate {
    const GroundCell* cell = nullptr;
    double off = 0;
  };

  // Edges always from the same end, so that neighbours split one that they share alike.
  void AddRing(const Ring& ring) {
    for (size_t i = 0; i < ring.size(); ++i) {
      const Eigen::Vector2d &a = ring[i], &b = ring[(i + 1) % ring.size()];
      const bool forwards = a.x() != b.x() ? a.x() < b.x() : a.y() < b.y();
      AddEdge(forwards ? Segment2d{a, b} : Segment2d{b, a});
    }
  }

  // In pieces between which the ground is straight: a triangle between a long edge and what is
  // measured just beside it would be a cliff.
  void AddEdge(const Segment2d& edge) {
    const Eigen::Vector2d along = edge.b - edge.a;
    const int steps = static_cast<int>(along.norm() / ground_.side());
    const double from = ground_.HeightAt(edge.a), to = ground_.HeightAt(edge.b);
    int worst = 0;
    double most = tolerance_ / 2;
    for (int i = 1; i < steps; ++i) {
      const double share = static_cast<double>(i) / steps;
      const double straight = from + share * (to - from);
      const double off = std::abs(ground_.HeightAt(edge.a + share * along) - straight);
      if (off <= most) continue;
      most = off;
      worst = i;
    }
    if (worst > 0) {
      const Eigen::Vector2d middle = edge.a + along * (static_cast<double>(worst) / steps);
      AddEdge({edge.a, middle});
      AddEdge({middle, edge.b});
    } else if (edge.a != edge.b) {
      mesh_.insert_constraint({edge.a.x(), edge.a.y()}, {edge.b.x(), edge.b.y()});
    }
  }

  // Whether a place lies so near to an edge of an outline that no triangle fits in between.
  bool IsAtEdge(Face face, const Eigen::Vector2d& p) const {
    constexpr double kNear = 0.4;  // cells
    for (int i = 0; i < 3; ++i) {
      if (!face->is_constrained(i)) continue;
      const Segment2d edge{CornerOf(face, (i + 1) % 3).head<2>(),
                           CornerOf(face, (i + 2) % 3).head<2>()};
      if (Distance(edge, p) < kNear * ground_.side()) return true;
    }
    return false;
  }

  bool IsTerrain(Face face) const {
    const Eigen::Vector2d middle =
        (CornerOf(face, 0) + CornerOf(face, 1) + CornerOf(face, 2)).head<2>() / 3;
    const auto over = boxes_.Touching({middle, middle});
    if (std::ranges::any_of(over, [&](int f) { return Contains(footprints_[f], middle); })) {
      return false;
    }
    return std::ranges::any_of(outlines_, [&](const Ring& ring) { return Contains(ring, middle); });
  }

  void NumberFaces() {
    faces_ = 0;
    for (auto face : mesh_.all_face_handles()) face->info() = -1;
    for (auto face : mesh_.finite_face_handles()) {
      if (IsTerrain(face)) face->info() = faces_++;
    }
  }

  // The seen cells that lie in a face of the terrain, each found from the one before.
  template <typename Visit>
  void ForEachCell(const Visit& visit) const {
    Face near;
    for (const GroundCell* cell : cells_) {
      near = mesh_.locate(Kernel::Point_2(cell->middle.x(), cell->middle.y()), near);
      if (near != nullptr && !mesh_.is_infinite(near) && near->info() >= 0) visit(near, *cell);
    }
  }

  const GroundHeights& ground_;
  std::span<const Ring> outlines_;
  std::span<const Polygon> footprints_;
  double tolerance_;
  BoxGrid boxes_;  // of the footprints
  Triangulation mesh_;
  std::vector<const GroundCell*> cells_;  // that were seen
  int faces_ = 0;
};

}  // namespace

std::vector<TerrainTriangle> MeshTerrain(const GroundHeights& ground,
                                         std::span<const Ring> outlines,
                                         std::span<const Polygon> footprints, double tolerance) {
  TerrainMesher mesher(ground, outlines, footprints, tolerance);
  mesher.Refine();
  return mesher.Triangles();
}

}  // namespace stucco
