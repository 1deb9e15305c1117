// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "survey/proxy.h"

namespace stucco {

// Triangles of one facet, counter-clockwise seen from outside.
struct FacetTriangles {
  std::vector<Eigen::Vector3d> vertices;  // outer ring, then the holes, in the facet's order
  std::vector<std::array<uint32_t, 3>> triangles;
};

// Constrained Delaunay triangulation of the polygon with holes. Rings that touch or cross are
// resolved by the even-odd rule; new vertices at crossings are appended.
FacetTriangles TriangulateFacet(const Facet& facet);

// Triangles of several facets. Corners at the very same place are one point.
struct TriangleSoup {
  std::vector<Eigen::Vector3d> points;
  std::vector<std::array<size_t, 3>> triangles;
};
TriangleSoup TriangulateFacets(std::span<const Facet> facets);

}  // namespace stucco
