// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "survey/proxy.h"

namespace stucco {

struct Triangulation {
  std::vector<Eigen::Vector3d> vertices;      // the outer ring, the holes, crossings
  std::vector<std::array<int, 3>> triangles;  // counter-clockwise seen from the facet's normal
};

// Constrained Delaunay triangulation of a facet's polygon. Adds no vertices but where its edges
// cross.
Triangulation Triangulate(const Facet& facet);

}  // namespace stucco
