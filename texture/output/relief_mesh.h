// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "survey/proxy.h"
#include "texture/grid/grid.h"

namespace stucco {

// A facet whose balconies stand out of it and whose windows lie back.
struct ReliefMesh {
  struct Vertex {
    Eigen::Vector3d position;  // world
    Eigen::Vector3d normal;    // world, unit
    Eigen::Vector2d texel;     // where its colour is on the facet's grid
  };
  std::vector<Vertex> vertices;
  std::vector<std::array<uint32_t, 3>> triangles;  // counter-clockwise seen from outside
};

// The facet cut along the edges of its relief, each piece before or behind the plane as it lies,
// with sides between pieces and along the outline, so that nothing is open. A picture of the facet
// has no colours for sides, as it looks at them edge on: they have those of the edge that stands
// out. Requires a grid with relief.
ReliefMesh MeshWithRelief(const Facet& facet, const TexelGrid& grid);

}  // namespace stucco
