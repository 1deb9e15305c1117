// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "dense/view.h"

namespace stucco {

// A plane as a camera sees it around one pixel: the inverse of a plane's depth is linear in the
// picture. Depths are along the optical axis, in units of the world; slopes are per pixel.
struct DepthPlane {
  float inverse_depth = 0;  // at the pixel
  float right = 0;          // what it grows by from one pixel to the next
  float down = 0;

  float At(int dx, int dy) const {
    return inverse_depth + right * static_cast<float>(dx) + down * static_cast<float>(dy);
  }
  // The same normal at another depth of the same pixel.
  DepthPlane MovedTo(float other) const {
    const float scale = other / inverse_depth;
    return {other, right * scale, down * scale};
  }
  float depth() const { return 1 / inverse_depth; }
};

// The plane at `depth` along the ray of pixel (x, y) with `normal` (camera frame, of any length),
// which must not be at right angles to that ray.
inline DepthPlane PlaneAcross(const PinholeCamera& view, int x, int y, float depth,
                              const Eigen::Vector3f& normal) {
  const Eigen::Vector3f ray = view.Ray(static_cast<float>(x), static_cast<float>(y));
  const float scale = 1 / (normal.dot(ray) * depth);
  return {1 / depth, normal.x() / view.fx * scale, normal.y() / view.fy * scale};
}

// Perpendicular to the plane of pixel (x, y), away from the camera, in the camera frame; its length
// is the inverse of the plane's distance from the camera.
inline Eigen::Vector3f AwayNormal(const PinholeCamera& view, int x, int y,
                                  const DepthPlane& plane) {
  return {view.fx * plane.right, view.fy * plane.down,
          plane.inverse_depth + (view.cx - static_cast<float>(x)) * plane.right +
              (view.cy - static_cast<float>(y)) * plane.down};
}

}  // namespace stucco
