// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "dense/depth_plane.h"
#include "dense/patch.h"
#include "dense/view.h"

namespace stucco {

// Takes planes of the reference camera to homographies into one source (Hartley & Zisserman 2004,
// result 13.1): H = infinite + epipole * m', where m' p is the plane's inverse depth at pixel p.
struct SourceGeometry {
  Eigen::Matrix3f infinite = Eigen::Matrix3f::Zero();
  Eigen::Vector3f epipole = Eigen::Vector3f::Zero();
  Eigen::Matrix3f source_from_reference = Eigen::Matrix3f::Zero();  // rotation
  Eigen::Vector3f translation = Eigen::Vector3f::Zero();

  SourceGeometry(const PinholeCamera& reference, const PinholeCamera& source) {
    source_from_reference = source.rotation * reference.rotation.transpose();
    const Eigen::Vector3d moved =
        source.translation - source_from_reference.cast<double>() * reference.translation;
    translation = moved.cast<float>();
    const Eigen::Matrix3f k_source = Intrinsics(source);
    infinite = k_source * source_from_reference * InverseIntrinsics(reference);
    epipole = k_source * translation;
  }

  // Around the reference's pixel (x, y), by the plane that the pixel shows.
  PatchWarp Warp(const DepthPlane& plane, int x, int y) const {
    const auto px = static_cast<float>(x);
    const auto py = static_cast<float>(y);
    PatchWarp warp;
    for (int row = 0; row < 3; ++row) {
      warp.right[row] = infinite(row, 0) + epipole[row] * plane.right;
      warp.down[row] = infinite(row, 1) + epipole[row] * plane.down;
      warp.at[row] = infinite(row, 0) * px + infinite(row, 1) * py + infinite(row, 2) +
                     epipole[row] * plane.inverse_depth;
      warp.nearer[row] = epipole[row];
    }
    return warp;
  }

  static Eigen::Matrix3f Intrinsics(const PinholeCamera& view) {
    Eigen::Matrix3f k;
    k << view.fx, 0, view.cx, 0, view.fy, view.cy, 0, 0, 1;
    return k;
  }
  static Eigen::Matrix3f InverseIntrinsics(const PinholeCamera& view) {
    Eigen::Matrix3f k;
    k << 1 / view.fx, 0, -view.cx / view.fx, 0, 1 / view.fy, -view.cy / view.fy, 0, 0, 1;
    return k;
  }
};

}  // namespace stucco
