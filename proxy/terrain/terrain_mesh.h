// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <span>
#include <vector>

#include "proxy/terrain/ground_heights.h"
#include "survey/geometry2d.h"

namespace stucco {

// A triangle of the ground, counter-clockwise from above, with what was seen of it.
struct TerrainTriangle {
  std::array<Eigen::Vector3d, 3> corners;
  int cells = 0;       // seen, whose middle lies in it
  int points = 0;      // of the cloud, in those
  double squares = 0;  // of their distances along z, summed
};

// Triangles over what lies inside `outlines` and outside of `footprints`, whose edges are edges of
// triangles: of a constrained Delaunay triangulation that begins with the corners of both and takes
// the middles of the cells that are farthest off, until all are within `tolerance` (greedy
// insertion: Garland and Heckbert, "Fast polygonal approximation of terrains and height fields",
// 1995, here all triangles at once). Corners have the height of the ground around them.
std::vector<TerrainTriangle> MeshTerrain(const GroundHeights& ground,
                                         std::span<const Ring> outlines,
                                         std::span<const Polygon> footprints, double tolerance);

}  // namespace stucco
