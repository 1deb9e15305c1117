// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace stucco {

// Rigid motion; as `cam_from_world` it takes world points into the camera frame:
// point_in_cam = rotation * point_in_world + translation.
struct Pose {
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();

  Eigen::Vector3d operator*(const Eigen::Vector3d& point) const {
    return rotation * point + translation;
  }
  Pose operator*(const Pose& other) const {
    return {(rotation * other.rotation).normalized(), rotation * other.translation + translation};
  }
  Pose Inverse() const { return {rotation.conjugate(), -(rotation.conjugate() * translation)}; }
  // Position of the camera in the world, when this is cam_from_world.
  Eigen::Vector3d Center() const { return -(rotation.conjugate() * translation); }
};

// p -> scale * rotation * p + translation.
struct Similarity {
  double scale = 1;
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();

  Eigen::Vector3d operator*(const Eigen::Vector3d& point) const {
    return scale * (rotation * point) + translation;
  }
  Similarity Inverse() const;  // requires scale > 0
};

// cam_from_new for cam_from_old and new_from_old; the camera frame keeps unit scale, so that depths
// in the new frame are `scale` times those in the old one.
Pose Transformed(const Pose& cam_from_old, const Similarity& new_from_old);

// Least-squares similarity (Umeyama 1991) with target ~ result * source, for 3 x n points that are
// not on one line. Throws Error (kStageFailed) for fewer than three, or not as many of both.
Similarity AlignPoints(const Eigen::Matrix3Xd& source, const Eigen::Matrix3Xd& target);

}  // namespace stucco
