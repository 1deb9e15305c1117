// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

namespace stucco {

// How wide a camera sees, without distortion.
struct FieldOfView {
  double half_width = 1;  // of the picture at a depth of 1
  double half_height = 1;
};

// What one picture shows: the pyramid of a camera, up to a distance.
struct Frustum {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::UnitX();  // unit vectors of the camera frame
  Eigen::Vector3d down = -Eigen::Vector3d::UnitZ();
  Eigen::Vector3d forward = Eigen::Vector3d::UnitY();
  double half_width = 1;  // of the picture at a depth of 1
  double half_height = 1;
  double reach_m = 0;

  bool Contains(const Eigen::Vector3d& point) const;
  // False only if no point of the box can be in the picture.
  bool MayTouch(const Eigen::Vector3d& box_min, const Eigen::Vector3d& box_max) const;
};

// Unit viewing direction (east, north, up): yaw clockwise from north, pitch 0 level, -pi/2 down.
Eigen::Vector3d LookingDirection(double yaw_rad, double pitch_rad);

// Of a camera with a level horizon. Looking straight down, the yaw still says where the top of the
// picture points.
Frustum LevelFrustum(const FieldOfView& field, const Eigen::Vector3d& position, double yaw_rad,
                     double pitch_rad, double reach_m);

// A place with the pictures taken there, which share their position and reach.
struct Viewpoint {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  std::vector<Frustum> pictures;
};

}  // namespace stucco
