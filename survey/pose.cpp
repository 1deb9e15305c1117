// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/pose.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <cassert>

#include "survey/error.h"

namespace stucco {

Similarity Similarity::Inverse() const {
  assert(scale > 0);
  const Eigen::Quaterniond back = rotation.conjugate();
  return {1 / scale, back, -(back * translation) / scale};
}

Pose Transformed(const Pose& cam_from_old, const Similarity& new_from_old) {
  // x_cam = R x_old + t with x_old = Q^T (x_new - u) / s; times s, so that the camera frame is
  // scaled with the world.
  Pose cam_from_new;
  cam_from_new.rotation = (cam_from_old.rotation * new_from_old.rotation.conjugate()).normalized();
  cam_from_new.translation = new_from_old.scale * cam_from_old.translation -
                             cam_from_new.rotation * new_from_old.translation;
  return cam_from_new;
}

Similarity AlignPoints(const Eigen::Matrix3Xd& source, const Eigen::Matrix3Xd& target) {
  if (source.cols() != target.cols() || source.cols() < 3) {
    throw Error(ErrorKind::kStageFailed,
                fmt::format("aligning {} to {} points: at least 3 pairs are needed", source.cols(),
                            target.cols()));
  }
  const Eigen::Matrix4d transform = Eigen::umeyama(source, target, /*with_scaling=*/true);
  const Eigen::Matrix3d linear = transform.topLeftCorner<3, 3>();
  Similarity result;
  result.scale = linear.col(0).norm();
  result.rotation = Eigen::Quaterniond(Eigen::Matrix3d(linear / result.scale)).normalized();
  result.translation = transform.topRightCorner<3, 1>();
  return result;
}

}  // namespace stucco
