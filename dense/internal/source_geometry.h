// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "dense/view.h"

namespace stucco {

// Takes planes of the reference camera to homographies into one source (Hartley & Zisserman 2004,
// result 13.1): H = infinite + epipole * m', where m holds the plane n'X = d as n' K^-1 / d.
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

  // Row-major homography of the plane through `point` (reference camera frame) with normal
  // `normal`.
  void Homography(const PinholeCamera& reference, const Eigen::Vector3f& point,
                  const Eigen::Vector3f& normal, float out[9]) const {
    const float inverse_d = 1 / normal.dot(point);
    const float mx = normal.x() / reference.fx * inverse_d;
    const float my = normal.y() / reference.fy * inverse_d;
    const float mz = normal.z() * inverse_d - mx * reference.cx - my * reference.cy;
    for (int row = 0; row < 3; ++row) {
      out[3 * row] = infinite(row, 0) + epipole[row] * mx;
      out[3 * row + 1] = infinite(row, 1) + epipole[row] * my;
      out[3 * row + 2] = infinite(row, 2) + epipole[row] * mz;
    }
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
