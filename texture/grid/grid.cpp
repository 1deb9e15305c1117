// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/grid/grid.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cassert>
#include <cmath>

#include "survey/rasterize.h"

namespace stucco {
namespace {

// Below this sine of the slope the horizontal direction of a facet is mostly noise.
constexpr double kLevelSine = 0.1;
// A facet this much wider than a whole number of texels does not get another one.
constexpr double kSlackTexels = 1e-6;

Eigen::Vector3d HorizontalAxis(const Eigen::Vector3d& normal, const Eigen::Vector3d& up) {
  const Eigen::Vector3d across = up.cross(normal);
  if (across.norm() > kLevelSine) return across.normalized();
  // Level: the world axis that lies best in the plane, x before y before z.
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::Vector3d unit = Eigen::Vector3d::Unit(axis);
    const Eigen::Vector3d in_plane = unit - unit.dot(normal) * normal;
    if (in_plane.norm() > 0.7) return in_plane.normalized();
  }
  return normal.unitOrthogonal();
}

std::vector<Eigen::Vector2d> OnGrid(const std::vector<Eigen::Vector3d>& ring,
                                    const TexelGrid& grid) {
  std::vector<Eigen::Vector2d> out;
  out.reserve(ring.size());
  for (const Eigen::Vector3d& vertex : ring) out.push_back(grid.From(vertex));
  return out;
}

}  // namespace

bool TexelGrid::ReliefHides(const Eigen::Vector3d& point, const Eigen::Vector3d& camera) const {
  if (!relief) return false;
  const auto along_axes = [&](const Eigen::Vector3d& in_world) {
    const Eigen::Vector3d offset = in_world - origin;
    return Eigen::Vector3d(offset.dot(u_axis), offset.dot(v_axis), offset.dot(normal));
  };
  return relief->Hides(along_axes(point), along_axes(camera));
}

TexelGrid MakeGrid(const Facet& facet, const Eigen::Vector3d& up, double texel, int max_px) {
  assert(texel > 0 && max_px >= 1 && facet.outer.size() >= 3);
  TexelGrid grid;
  grid.normal = facet.normal.normalized();
  grid.u_axis = HorizontalAxis(grid.normal, up.normalized());
  grid.v_axis = grid.u_axis.cross(grid.normal);
  Eigen::Vector2d low = Eigen::Vector2d::Constant(std::numeric_limits<double>::max());
  Eigen::Vector2d high = -low;
  for (const Eigen::Vector3d& vertex : facet.outer) {
    const Eigen::Vector3d offset = vertex - facet.outer.front();
    const Eigen::Vector2d uv(offset.dot(grid.u_axis), offset.dot(grid.v_axis));
    low = low.cwiseMin(uv);
    high = high.cwiseMax(uv);
  }
  const Eigen::Vector2d extent = high - low;
  grid.texel = std::max(texel, extent.maxCoeff() / max_px);
  grid.origin = facet.outer.front() + low.x() * grid.u_axis + low.y() * grid.v_axis;
  const auto count = [&](double length) {
    return std::clamp(static_cast<int>(std::ceil(length / grid.texel - kSlackTexels)), 1, max_px);
  };
  grid.width = count(extent.x());
  grid.height = count(extent.y());
  return grid;
}

TexelGrid GridOf(const TexturedFacet& textured, const Facet& facet) {
  assert(textured.width_px > 0 && textured.height_px > 0);
  return {
      textured.origin,           textured.u_axis,   textured.v_axis,    facet.normal.normalized(),
      textured.metres_per_texel, textured.width_px, textured.height_px, {}};
}

TexelGrid Coarsened(const TexelGrid& grid, int step) {
  TexelGrid coarse = grid;
  coarse.texel = grid.texel * step;
  coarse.width = (grid.width + step - 1) / step;
  coarse.height = (grid.height + step - 1) / step;
  return coarse;
}

std::vector<uint8_t> RasterizeFacet(const Facet& facet, const TexelGrid& grid) {
  std::vector<std::vector<Eigen::Vector2d>> rings = {OnGrid(facet.outer, grid)};
  for (const auto& hole : facet.holes) rings.push_back(OnGrid(hole, grid));
  std::vector<uint8_t> mask = RasterizeRings(rings, grid.width, grid.height);
  if (std::find(mask.begin(), mask.end(), 1) == mask.end()) {
    Eigen::Vector2d mean = Eigen::Vector2d::Zero();
    for (const Eigen::Vector2d& vertex : rings.front()) mean += vertex;
    mean /= static_cast<double>(rings.front().size());
    const int column = std::clamp(static_cast<int>(mean.x()), 0, grid.width - 1);
    const int row = std::clamp(static_cast<int>(mean.y()), 0, grid.height - 1);
    mask[static_cast<size_t>(row) * grid.width + column] = 1;
  }
  return mask;
}

std::vector<uint16_t> CountInside(const TexelGrid& grid, const std::vector<uint8_t>& mask,
                                  int step) {
  const TexelGrid coarse = Coarsened(grid, step);
  std::vector<uint16_t> count(coarse.size(), 0);
  for (int row = 0; row < grid.height; ++row) {
    for (int column = 0; column < grid.width; ++column) {
      count[static_cast<size_t>(row / step) * coarse.width + column / step] +=
          mask[static_cast<size_t>(row) * grid.width + column];
    }
  }
  return count;
}

}  // namespace stucco
