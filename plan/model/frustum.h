// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "plan/camera/preset.h"
#include "plan/hover.h"

namespace stucco::plan {

// What one shot has in its picture: the pyramid of a camera with a level horizon, up to a distance.
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

Frustum FrustumOf(const CameraPreset& camera, const Eigen::Vector3d& position, const Shot& shot,
                  double reach_m);

}  // namespace stucco::plan
