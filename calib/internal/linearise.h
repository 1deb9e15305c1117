// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "calib/scene.h"
#include "survey/pose.h"

namespace stucco {

struct Linearised {
  Eigen::Vector2d residual = Eigen::Vector2d::Zero();
  Eigen::Matrix<double, 2, Eigen::Dynamic, Eigen::RowMajor> intrinsics;
  Eigen::Matrix<double, 2, 6, Eigen::RowMajor> pose;
  Eigen::Matrix<double, 2, 3, Eigen::RowMajor> point;
};

// Residual and derivatives of an observation; false where the point has no picture. The pose
// changes as Ceres' manifold does: the rotation by twice the vector d (q' = exp(d) q), and the
// translation.
bool Linearise(const Scene& scene, const SceneElement& element, const Eigen::Vector3d& point,
               Linearised& out);

// Derivatives of the centre by such a change.
Eigen::Matrix<double, 3, 6> CenterByPose(const Pose& pose);

}  // namespace stucco
