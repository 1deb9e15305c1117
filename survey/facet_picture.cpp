// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/facet_picture.h"

#include <Eigen/Geometry>
#include <cassert>
#include <cmath>
#include <limits>

namespace stucco {
namespace {

// How far a picture may be from a facet's plane and outline: its outermost texels stick out.
constexpr double kFitSlack_px = 2;
constexpr double kFitCosine = 0.9999;

bool HasSize(const TexturedFacet& picture) {
  return picture.width_px > 0 && picture.height_px > 0 && picture.metres_per_texel > 0;
}

}  // namespace

Eigen::Vector2d OnPicture(const TexturedFacet& picture, const Eigen::Vector3d& point_in_world) {
  assert(HasSize(picture));
  const Eigen::Vector3d offset = (point_in_world - picture.origin) / picture.metres_per_texel;
  return {offset.dot(picture.u_axis) / picture.width_px,
          offset.dot(picture.v_axis) / picture.height_px};
}

bool FitsFacet(const TexturedFacet& picture, const Facet& facet) {
  if (!HasSize(picture)) return false;
  const double slack = kFitSlack_px * picture.metres_per_texel;
  if (!(std::abs(facet.normal.dot(picture.origin) - facet.offset) <= slack)) return false;
  if (!(picture.u_axis.cross(picture.v_axis).dot(facet.normal) <= -kFitCosine)) return false;
  const Eigen::Array2d size_px(picture.width_px, picture.height_px);
  Eigen::Array2d low = Eigen::Array2d::Constant(std::numeric_limits<double>::max());
  Eigen::Array2d high = -low;
  for (const Eigen::Vector3d& vertex : facet.outer) {
    const Eigen::Array2d texel = OnPicture(picture, vertex).array() * size_px;
    low = low.min(texel);
    high = high.max(texel);
  }
  return low.abs().maxCoeff() <= kFitSlack_px && (high - size_px).abs().maxCoeff() <= kFitSlack_px;
}

}  // namespace stucco
