// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "calib/scene/scene.h"
#include "survey/pose.h"

namespace stucco {

// The similarity that fits small motions of all centres best (weighted least squares): translation,
// turn about the middle and scale.
class Datum {
 public:
  using Matrix37 = Eigen::Matrix<double, 3, 7>;
  using Matrix73 = Eigen::Matrix<double, 7, 3>;

  // Weights are by photo, 0 where there is no pose.
  Datum(const Scene& scene, const Eigen::VectorXd& weights);

  // Of photo `i`, which must have a pose.
  Matrix73 ByCenter(size_t i) const {
    return weights_[i] * inverse_ * CenterBySimilarity(i).transpose();
  }
  Matrix37 CenterBySimilarity(size_t i) const;
  // Of the rotation vector in the camera's frame: the camera turns against the world.
  static Matrix37 RotationBySimilarity(const Pose& pose);

 private:
  Eigen::VectorXd weights_;
  std::vector<Eigen::Vector3d> offsets_;  // from the middle
  Eigen::Matrix<double, 7, 7> inverse_;
};

}  // namespace stucco
