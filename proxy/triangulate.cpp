// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/triangulate.h"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Constrained_triangulation_face_base_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_data_structure_2.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <Eigen/Geometry>
#include <deque>
#include <map>

#include "proxy/plane.h"

namespace stucco {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
struct VertexNumber {
  int value = -1;  // index into Triangulation::vertices; -1: a crossing of two edges
};
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<VertexNumber, Kernel>;
// Info of a face: how many borders lie between it and the outside; -1 while not known.
using FaceBase =
    CGAL::Triangulation_face_base_with_info_2<int, Kernel,
                                              CGAL::Constrained_triangulation_face_base_2<Kernel>>;
using Structure = CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>;
using Delaunay =
    CGAL::Constrained_Delaunay_triangulation_2<Kernel, Structure, CGAL::Exact_predicates_tag>;

void CountBorders(Delaunay& delaunay) {
  for (auto face = delaunay.all_faces_begin(); face != delaunay.all_faces_end(); ++face) {
    face->info() = -1;
  }
  std::deque<Delaunay::Face_handle> queue = {delaunay.infinite_face()};
  delaunay.infinite_face()->info() = 0;
  while (!queue.empty()) {
    const auto face = queue.front();
    queue.pop_front();
    for (int i = 0; i < 3; ++i) {
      const auto next = face->neighbor(i);
      if (next->info() >= 0) continue;
      const bool border = delaunay.is_constrained({face, i});
      next->info() = face->info() + (border ? 1 : 0);
      // Crossing as few borders as possible first: no wave over a border while others are open.
      if (border) {
        queue.push_back(next);
      } else {
        queue.push_front(next);
      }
    }
  }
}

}  // namespace

Triangulation Triangulate(const Facet& facet) {
  Triangulation result;
  const Eigen::Vector3d u = AnyPerpendicular(facet.normal);
  const Eigen::Vector3d v = facet.normal.cross(u);
  Delaunay delaunay;
  const auto add_ring = [&](const std::vector<Eigen::Vector3d>& ring) {
    std::vector<Delaunay::Vertex_handle> handles;
    for (const auto& p : ring) {
      const auto handle = delaunay.insert(Kernel::Point_2(u.dot(p), v.dot(p)));
      handle->info().value = static_cast<int>(result.vertices.size());
      result.vertices.push_back(p);
      handles.push_back(handle);
    }
    for (size_t i = 0; i < handles.size(); ++i) {
      const auto next = handles[(i + 1) % handles.size()];
      if (handles[i] != next) delaunay.insert_constraint(handles[i], next);
    }
  };
  add_ring(facet.outer);
  for (const auto& hole : facet.holes) add_ring(hole);
  CountBorders(delaunay);
  for (auto vertex = delaunay.finite_vertices_begin(); vertex != delaunay.finite_vertices_end();
       ++vertex) {
    if (vertex->info().value >= 0) continue;
    vertex->info().value = static_cast<int>(result.vertices.size());
    result.vertices.push_back(vertex->point().x() * u + vertex->point().y() * v +
                              facet.offset * facet.normal);
  }
  for (auto face = delaunay.finite_faces_begin(); face != delaunay.finite_faces_end(); ++face) {
    if (face->info() % 2 == 0) continue;
    const auto number = [&](int corner) { return face->vertex(corner)->info().value; };
    result.triangles.push_back({number(0), number(1), number(2)});
  }
  return result;
}

}  // namespace stucco
