// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <vector>

#include "survey/proxy.h"
#include "survey/texture_set.h"
#include "texture/grid/relief.h"

namespace stucco {

// A raster on a facet's plane. Positions on it are in texels: (0, 0) is the corner of the first
// texel, (0.5, 0.5) its centre, x along `u_axis`, y along `v_axis`.
struct TexelGrid {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();   // world, corner of the first texel
  Eigen::Vector3d u_axis = Eigen::Vector3d::UnitX();  // unit, to the right seen from outside
  Eigen::Vector3d v_axis = Eigen::Vector3d::UnitY();  // unit, downwards
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  // unit, outwards
  double texel = 1;                                   // side of a texel, world units
  int width = 0;
  int height = 0;
  std::shared_ptr<const Relief> relief;  // none: all is on the plane

  size_t size() const { return static_cast<size_t>(width) * height; }
  // What the facet shows there lies this far before its plane, world units.
  double HeightAt(double x, double y) const {
    return relief ? relief->HeightAt(x * texel, y * texel) : 0;
  }
  Eigen::Vector3d AtHeight(double x, double y, double height_in_world) const {
    return origin + texel * (x * u_axis + y * v_axis) + height_in_world * normal;
  }
  Eigen::Vector3d At(double x, double y) const { return AtHeight(x, y, HeightAt(x, y)); }
  Eigen::Vector3d Center(int column, int row) const { return At(column + 0.5, row + 0.5); }
  Eigen::Vector2d From(const Eigen::Vector3d& point_in_world) const {
    const Eigen::Vector3d offset = (point_in_world - origin) / texel;
    return {offset.dot(u_axis), offset.dot(v_axis)};
  }
  // Whether relief stands between a point on it and a camera, both in the world.
  bool ReliefHides(const Eigen::Vector3d& point, const Eigen::Vector3d& camera) const;
};

// The smallest grid around the facet with texels of the given size, which grow where the longer
// side would exceed `max_px`. On walls and sloping roofs u is horizontal; where the facet is level
// (within 6 degrees) u is the world's x axis, so that a map's east stays on the right.
// Requires texel > 0, max_px >= 1 and a facet with at least 3 vertices.
TexelGrid MakeGrid(const Facet& facet, const Eigen::Vector3d& up, double texel, int max_px);

// The grid that a facet's picture was painted on. Requires one with a picture.
TexelGrid GridOf(const TexturedFacet& textured, const Facet& facet);

// A coarser raster over a facet, and how much of it is the facet's.
struct FacetRaster {
  TexelGrid grid;
  std::vector<uint16_t> inside;  // by texel, between 0 and `full`
  int full = 1;
};

// The same plane with texels `step` times as large; the last column and row may stick out.
TexelGrid Coarsened(const TexelGrid& grid, int step);

// 1 where the texel's centre is inside the polygon and outside its holes (even-odd rule). A polygon
// too thin for any centre marks the texel at the mean of its vertices, so that nothing vanishes.
std::vector<uint8_t> RasterizeFacet(const Facet& facet, const TexelGrid& grid);

// Number of set texels below each texel of Coarsened(grid, step), by row.
std::vector<uint16_t> CountInside(const TexelGrid& grid, const std::vector<uint8_t>& mask,
                                  int step);

}  // namespace stucco
