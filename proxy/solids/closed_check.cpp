// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/solids/closed_check.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>
#include <fmt/format.h>

#include <array>
#include <map>
#include <utility>
#include <vector>

#include "survey/triangulate.h"

namespace stucco {
namespace {

namespace pmp = CGAL::Polygon_mesh_processing;
using InexactKernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<InexactKernel::Point_3>;

// Points as CGAL has them.
std::vector<InexactKernel::Point_3> PointsOf(const TriangleSoup& soup) {
  std::vector<InexactKernel::Point_3> points;
  for (const Eigen::Vector3d& p : soup.points) points.emplace_back(p.x(), p.y(), p.z());
  return points;
}

// Every directed edge once, and its opposite once.
std::optional<std::string> FindEdgeProblem(const TriangleSoup& soup) {
  std::map<std::pair<size_t, size_t>, int> edges;
  for (const auto& t : soup.triangles) {
    for (size_t i = 0; i < 3; ++i) ++edges[{t[i], t[(i + 1) % 3]}];
  }
  for (const auto& [edge, count] : edges) {
    if (count > 1) return "an edge has more than two facets, or two facets face opposite ways";
    if (edges.find({edge.second, edge.first}) == edges.end()) {
      const auto& p = soup.points[edge.first];
      return fmt::format("open at an edge near ({:.3f}, {:.3f}, {:.3f})", p.x(), p.y(), p.z());
    }
  }
  return std::nullopt;
}

}  // namespace

std::optional<std::string> FindOpening(const std::vector<Facet>& facets) {
  const TriangleSoup soup = TriangulateFacets(facets);
  if (soup.triangles.size() < 4) return "fewer than four triangles";
  if (auto problem = FindEdgeProblem(soup)) return problem;
  if (!pmp::is_polygon_soup_a_polygon_mesh(soup.triangles)) return "not 2-manifold";
  Mesh mesh;
  pmp::polygon_soup_to_polygon_mesh(PointsOf(soup), soup.triangles, mesh);
  // Parts that touch in a vertex only are one vertex of the soup and several of the mesh.
  if (mesh.number_of_vertices() != soup.points.size()) return "parts touch in a vertex";
  if (!CGAL::is_closed(mesh)) return "not closed";
  if (pmp::does_self_intersect(mesh)) return "crosses itself";
  if (!pmp::is_outward_oriented(mesh)) return "facets face inwards";
  if (!pmp::does_bound_a_volume(mesh)) return "a part of it faces inwards";
  return std::nullopt;
}

}  // namespace stucco
