// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/adjust/datum.h"

#include <Eigen/QR>

namespace stucco {

Datum::Datum(const Scene& scene, const Eigen::VectorXd& weights)
    : weights_(weights), offsets_(scene.photos.size(), Eigen::Vector3d::Zero()) {
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (size_t i = 0; i < offsets_.size(); ++i) {
    if (weights_[i] > 0) middle += weights_[i] / weights_.sum() * scene.photos[i].pose->Center();
  }
  Eigen::Matrix<double, 7, 7> normal = Eigen::Matrix<double, 7, 7>::Zero();
  for (size_t i = 0; i < offsets_.size(); ++i) {
    if (!scene.photos[i].pose) continue;
    offsets_[i] = scene.photos[i].pose->Center() - middle;
    normal += weights_[i] * CenterBySimilarity(i).transpose() * CenterBySimilarity(i);
  }
  // Places on a line do not say how they turn about it.
  inverse_ = normal.completeOrthogonalDecomposition().pseudoInverse();
}

Datum::Matrix37 Datum::CenterBySimilarity(size_t i) const {
  const Eigen::Vector3d& x = offsets_[i];
  Matrix37 by_similarity;
  by_similarity << Eigen::Matrix3d::Identity(),
      (Eigen::Matrix3d() << 0, x.z(), -x.y(), -x.z(), 0, x.x(), x.y(), -x.x(), 0).finished(), x;
  return by_similarity;
}

Datum::Matrix37 Datum::RotationBySimilarity(const Pose& pose) {
  Matrix37 by_similarity = Matrix37::Zero();
  by_similarity.middleCols<3>(3) = -pose.rotation.toRotationMatrix();
  return by_similarity;
}

}  // namespace stucco
