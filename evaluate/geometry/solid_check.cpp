// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "evaluate/geometry/solid_check.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <map>
#include <utility>
#include <vector>

#include "survey/triangulate.h"

namespace stucco::evaluate {
namespace {

namespace pmp = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;

// Six times the volume, where the triangles enclose one and face out.
double SignedVolume(const TriangleSoup& soup) {
  double sum = 0;
  const auto at = [&](size_t i) -> Eigen::Vector3d { return soup.points[i] - soup.points[0]; };
  for (const auto& t : soup.triangles) sum += at(t[0]).dot(at(t[1]).cross(at(t[2])));
  return sum;
}

void CheckEdges(const TriangleSoup& soup, SolidCheck& check) {
  std::map<std::pair<size_t, size_t>, std::array<int, 2>> uses;  // by direction
  for (const auto& t : soup.triangles) {
    for (size_t i = 0; i < 3; ++i) {
      const size_t from = t[i], to = t[(i + 1) % 3];
      ++uses[std::minmax(from, to)][from < to ? 0 : 1];
    }
  }
  check.closed = check.manifold = check.oriented = true;
  for (const auto& [edge, by_direction] : uses) {
    const int all = by_direction[0] + by_direction[1];
    check.closed = check.closed && all > 1;
    check.manifold = check.manifold && all <= 2;
    check.oriented = check.oriented && by_direction[0] <= 1 && by_direction[1] <= 1;
  }
  if (check.closed) check.oriented = check.oriented && SignedVolume(soup) > 0;
}

}  // namespace

SolidCheck CheckSolid(std::span<const Facet> facets) {
  SolidCheck check;
  TriangleSoup soup = TriangulateFacets(facets);
  if (soup.triangles.empty()) return check;
  CheckEdges(soup, check);
  // Turns triangles so that they agree, and doubles corners where that makes a manifold of it.
  std::vector<Kernel::Point_3> points;
  for (const Eigen::Vector3d& p : soup.points) points.emplace_back(p.x(), p.y(), p.z());
  const bool was_manifold = pmp::orient_polygon_soup(points, soup.triangles);
  check.manifold = check.manifold && was_manifold;
  Mesh mesh;
  pmp::polygon_soup_to_polygon_mesh(points, soup.triangles, mesh);
  check.crosses_itself = pmp::does_self_intersect(mesh);
  return check;
}

}  // namespace stucco::evaluate
