// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/adjust/internal/linearise.h"

#include <ceres/manifold.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "calib/adjust/internal/costs.h"

namespace stucco {
namespace {

using Matrix36 = Eigen::Matrix<double, 3, 6>;
using Matrix2X = Eigen::Matrix<double, 2, Eigen::Dynamic, Eigen::RowMajor>;

std::unique_ptr<ceres::CostFunction> CostOf(const Camera& camera, const Eigen::Vector2d& keypoint,
                                            double sigma) {
  switch (camera.params.size()) {
    case 4:
      return std::make_unique<ReprojectionCost<4>>(keypoint, sigma);
    case 8:
      return std::make_unique<ReprojectionCost<8>>(keypoint, sigma);
    default:
      return std::make_unique<ReprojectionCost<12>>(keypoint, sigma);
  }
}

}  // namespace

bool Linearise(const Scene& scene, const SceneElement& element, const Eigen::Vector3d& point,
               Linearised& out) {
  const ScenePhoto& photo = scene.photos[element.photo];
  const Camera& camera = scene.CameraOf(element.photo);
  const int num_params = static_cast<int>(camera.params.size());
  const auto cost =
      CostOf(camera, photo.keypoints[element.keypoint], photo.KeypointSigma(element.keypoint));
  out.intrinsics.resize(2, num_params);
  Eigen::Matrix<double, 2, kPoseSize, Eigen::RowMajor> by_pose;
  Eigen::Matrix<double, kPoseSize, 1> pose;
  pose << photo.pose->rotation.coeffs(), photo.pose->translation;
  const double* blocks[] = {camera.params.data(), pose.data(), point.data()};
  double* jacobians[] = {out.intrinsics.data(), by_pose.data(), out.point.data()};
  if (!cost->Evaluate(blocks, out.residual.data(), jacobians)) return false;
  Eigen::Matrix<double, 4, 3, Eigen::RowMajor> plus;
  ceres::EigenQuaternionManifold().PlusJacobian(photo.pose->rotation.coeffs().data(), plus.data());
  out.pose.leftCols<3>() = by_pose.leftCols<4>() * plus;
  out.pose.rightCols<3>() = by_pose.rightCols<3>();
  return true;
}

Eigen::Matrix<double, 3, 6> CenterByPose(const Pose& pose) {
  const Eigen::Vector3d& t = pose.translation;
  Eigen::Matrix3d cross;
  cross << 0, -t.z(), t.y(), t.z(), 0, -t.x(), -t.y(), t.x(), 0;
  const Eigen::Matrix3d world_from_cam = pose.rotation.conjugate().toRotationMatrix();
  Matrix36 by_pose;
  by_pose << -2 * world_from_cam * cross, -world_from_cam;
  return by_pose;
}

}  // namespace stucco
