// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/triangulate.h"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <Eigen/Geometry>
#include <map>
#include <vector>

namespace stucco {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
// Depth: number of constraints crossed from the outside; odd is inside the polygon. -1: not known.
using FaceBase =
    CGAL::Triangulation_face_base_with_info_2<int, Kernel,
                                              CGAL::Constrained_triangulation_face_base_2<Kernel>>;
struct VertexNumber {
  int value = -1;  // index into FacetTriangles::vertices; -1: a crossing of two edges
};
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<VertexNumber, Kernel>;
using Structure = CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>;
using Triangulation =
    CGAL::Constrained_Delaunay_triangulation_2<Kernel, Structure, CGAL::Exact_predicates_tag>;

void MarkDepth(Triangulation& triangulation) {
  for (auto face : triangulation.all_face_handles()) face->info() = -1;
  std::vector<Triangulation::Face_handle> stack = {triangulation.infinite_face()};
  std::vector<Triangulation::Face_handle> next;
  for (int depth = 0; !stack.empty(); ++depth, stack.swap(next), next.clear()) {
    while (!stack.empty()) {
      const auto face = stack.back();
      stack.pop_back();
      if (face->info() >= 0) continue;
      face->info() = depth;
      for (int i = 0; i < 3; ++i) {
        if (face->neighbor(i)->info() >= 0) continue;
        (face->is_constrained(i) ? next : stack).push_back(face->neighbor(i));
      }
    }
  }
}

}  // namespace

FacetTriangles TriangulateFacet(const Facet& facet) {
  FacetTriangles out;
  if (facet.outer.size() < 3) return out;
  const Eigen::Vector3d u = facet.normal.unitOrthogonal();
  const Eigen::Vector3d v = facet.normal.cross(u);
  const Eigen::Vector3d origin = facet.outer.front();

  Triangulation triangulation;
  const auto add_ring = [&](const std::vector<Eigen::Vector3d>& ring) {
    std::vector<Triangulation::Vertex_handle> handles;
    for (const Eigen::Vector3d& vertex : ring) {
      const Eigen::Vector3d offset = vertex - origin;
      const auto handle = triangulation.insert(Kernel::Point_2(offset.dot(u), offset.dot(v)));
      handle->info().value = static_cast<int>(out.vertices.size());
      out.vertices.push_back(vertex);
      handles.push_back(handle);
    }
    for (size_t i = 0; i < handles.size(); ++i) {
      const auto next = handles[(i + 1) % handles.size()];
      if (handles[i] != next) triangulation.insert_constraint(handles[i], next);
    }
  };
  add_ring(facet.outer);
  for (const auto& hole : facet.holes) add_ring(hole);
  MarkDepth(triangulation);

  for (auto vertex : triangulation.finite_vertex_handles()) {
    if (vertex->info().value >= 0) continue;
    vertex->info().value = static_cast<int>(out.vertices.size());
    out.vertices.push_back(origin + vertex->point().x() * u + vertex->point().y() * v);
  }
  for (auto face : triangulation.finite_face_handles()) {
    if (face->info() % 2 == 0) continue;
    std::array<uint32_t, 3> triangle;
    for (int i = 0; i < 3; ++i) {
      triangle[i] = static_cast<uint32_t>(face->vertex(i)->info().value);
    }
    out.triangles.push_back(triangle);
  }
  return out;
}

TriangleSoup TriangulateFacets(std::span<const Facet> facets) {
  TriangleSoup soup;
  std::map<std::array<double, 3>, size_t> numbers;
  for (const Facet& facet : facets) {
    const FacetTriangles pieces = TriangulateFacet(facet);
    for (const auto& corners : pieces.triangles) {
      auto& triangle = soup.triangles.emplace_back();
      for (size_t i = 0; i < 3; ++i) {
        const Eigen::Vector3d& p = pieces.vertices[corners[i]];
        const auto [entry, added] = numbers.try_emplace({p.x(), p.y(), p.z()}, soup.points.size());
        if (added) soup.points.push_back(p);
        triangle[i] = entry->second;
      }
    }
  }
  return soup;
}

}  // namespace stucco
