// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/output/relief_mesh.h"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <Eigen/Geometry>
#include <cassert>
#include <map>
#include <span>
#include <utility>

#include "survey/geometry2d.h"

namespace stucco {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
// What lies on a facet's plane: x along the grid's u, y against its v, world units from the grid's
// origin, so that counter-clockwise is so from outside.
using Plane =
    CGAL::Constrained_Delaunay_triangulation_2<Kernel, CGAL::Default, CGAL::Exact_predicates_tag>;

Eigen::Vector2d VectorOf(const Kernel::Point_2& p) {
  return {p.x(), p.y()};
}

class Mesher {
 public:
  Mesher(const Facet& facet, const TexelGrid& grid) : grid_(grid), relief_(*grid.relief) {
    AddRing(facet.outer);
    for (const auto& hole : facet.holes) AddRing(hole);
    CutAlongColumns();
    CutAlongRows();
  }

  ReliefMesh Build() {
    for (const auto face : plane_.finite_face_handles()) {
      if (!IsInside(face)) continue;
      AddFront(face);
      for (int i = 0; i < 3; ++i) AddSide(face, i);
    }
    return std::move(mesh_);
  }

 private:
  using Face = Plane::Face_handle;

  void AddRing(std::span<const Eigen::Vector3d> ring) {
    Ring& flat = outline_.rings.emplace_back();
    for (const Eigen::Vector3d& p : ring) {
      const Eigen::Vector3d offset = p - grid_.origin;
      flat.emplace_back(offset.dot(grid_.u_axis), -offset.dot(grid_.v_axis));
    }
    for (size_t i = 0; i < flat.size(); ++i) Cut(flat[i], flat[(i + 1) % flat.size()]);
  }
  void Cut(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    if (a == b) return;
    plane_.insert_constraint(Kernel::Point_2(a.x(), a.y()), Kernel::Point_2(b.x(), b.y()));
  }
  // Cells are numbered; beyond the raster nothing differs.
  float Height(int column, int row) const {
    return relief_.heights[static_cast<size_t>(row) * relief_.width + column];
  }
  Eigen::Vector2d Corner(int column, int row) const {
    return {column * relief_.cell, -row * relief_.cell};
  }
  void CutAlongColumns() {
    for (int column = 1; column < relief_.width; ++column) {
      const auto differs = [&](int row) { return Height(column - 1, row) != Height(column, row); };
      for (int row = 0; row < relief_.height;) {
        const int first = row;
        while (row < relief_.height && differs(row)) ++row;
        if (row > first) Cut(Corner(column, first), Corner(column, row));
        ++row;
      }
    }
  }
  void CutAlongRows() {
    for (int row = 1; row < relief_.height; ++row) {
      const auto differs = [&](int column) {
        return Height(column, row - 1) != Height(column, row);
      };
      for (int column = 0; column < relief_.width;) {
        const int first = column;
        while (column < relief_.width && differs(column)) ++column;
        if (column > first) Cut(Corner(first, row), Corner(column, row));
        ++column;
      }
    }
  }

  static Eigen::Vector2d MiddleOf(Face face) {
    return (VectorOf(face->vertex(0)->point()) + VectorOf(face->vertex(1)->point()) +
            VectorOf(face->vertex(2)->point())) /
           3;
  }
  bool IsInside(Face face) const {
    if (plane_.is_infinite(face)) return false;
    const Eigen::Vector2d middle = MiddleOf(face);
    bool inside = false;
    for (const Ring& ring : outline_.rings) inside ^= Contains(ring, middle);
    return inside;
  }
  double HeightOf(Face face) const {
    const Eigen::Vector2d middle = MiddleOf(face);
    return relief_.HeightAt(middle.x(), -middle.y());
  }

  // A corner of a piece, its colour from a place on the plane.
  uint32_t Add(const Eigen::Vector2d& p, double height, const Eigen::Vector2d& colour_at,
               const Eigen::Vector3d& normal) {
    const Eigen::Vector2d at = p / grid_.texel, from = colour_at / grid_.texel;
    mesh_.vertices.push_back(
        {grid_.AtHeight(at.x(), -at.y(), height), normal, {from.x(), -from.y()}});
    return static_cast<uint32_t>(mesh_.vertices.size() - 1);
  }
  void AddFront(Face face) {
    const double height = HeightOf(face);
    std::array<uint32_t, 3> triangle = {};
    for (int i = 0; i < 3; ++i) {
      const Eigen::Vector2d p = VectorOf(face->vertex(i)->point());
      const auto [known, is_new] = fronts_.try_emplace({p.x(), p.y(), height}, 0);
      if (is_new) known->second = Add(p, height, p, grid_.normal);
      triangle[i] = known->second;
    }
    mesh_.triangles.push_back(triangle);
  }
  // The side below an edge of a piece that stands out more than what is beyond it; and where a
  // piece at the outline lies back, that of the outline.
  void AddSide(Face face, int opposite) {
    const Face beyond = face->neighbor(opposite);
    const bool is_outline = !IsInside(beyond);
    const double here = HeightOf(face), there = is_outline ? 0 : HeightOf(beyond);
    if (here == there || (here < there && !is_outline)) return;
    const Eigen::Vector2d a = VectorOf(face->vertex(Plane::ccw(opposite))->point());
    const Eigen::Vector2d b = VectorOf(face->vertex(Plane::cw(opposite))->point());
    const Eigen::Vector2d onwards = (b - a).normalized();
    const Eigen::Vector2d inwards(-onwards.y(), onwards.x());
    const Eigen::Vector2d colour = 1.5 * grid_.texel * inwards;  // the edge itself belongs to both
    if (here > there) {
      AddQuad(a, b, {there, here}, colour);
    } else {
      AddQuad(b, a, {here, there}, colour);
    }
  }
  // Seen with the higher end up: from a on the left to b on the right, from low to high.
  void AddQuad(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const std::array<double, 2>& z,
               const Eigen::Vector2d& colour) {
    const Eigen::Vector2d onwards = (b - a).normalized();
    const Eigen::Vector3d normal = onwards.y() * grid_.u_axis + onwards.x() * grid_.v_axis;
    const uint32_t first = Add(a, z[0], a + colour, normal);
    Add(b, z[0], b + colour, normal);
    Add(b, z[1], b + colour, normal);
    Add(a, z[1], a + colour, normal);
    mesh_.triangles.push_back({first, first + 1, first + 2});
    mesh_.triangles.push_back({first, first + 2, first + 3});
  }

  const TexelGrid& grid_;
  const Relief& relief_;
  Polygon outline_;
  Plane plane_;
  ReliefMesh mesh_;
  std::map<std::array<double, 3>, uint32_t> fronts_;  // vertices by place and height
};

}  // namespace

ReliefMesh MeshWithRelief(const Facet& facet, const TexelGrid& grid) {
  assert(grid.relief);
  return Mesher(facet, grid).Build();
}

}  // namespace stucco
