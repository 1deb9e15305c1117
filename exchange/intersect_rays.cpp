// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "exchange/intersect_rays.h"

#include <Eigen/Eigenvalues>

namespace stucco {

std::optional<Eigen::Vector3d> IntersectRays(const ExchangedPoint& point,
                                             const Reconstruction& model) {
  // Least squares of the distances to the rays.
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  int rays = 0;
  for (const auto& [id, pixel] : point.pixels) {
    const RegisteredImage& photo = model.photos.at(id);
    const auto ray = model.cameras.at(photo.camera).Unproject(pixel);
    if (!ray) continue;
    const Eigen::Vector3d direction =
        (photo.cam_from_world.rotation.conjugate() * ray->homogeneous()).normalized();
    const Eigen::Matrix3d across = Eigen::Matrix3d::Identity() - direction * direction.transpose();
    normal += across;
    right += across * photo.cam_from_world.Center();
    ++rays;
  }
  if (rays < 2) return std::nullopt;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(normal);
  // The square of the sine of a degree: below, the depth is little more than noise.
  constexpr double kLeastSquaredSine = 3e-4;
  if (!(solver.eigenvalues()[0] > kLeastSquaredSine)) return std::nullopt;
  const Eigen::Vector3d position =
      solver.eigenvectors() *
      solver.eigenvalues().cwiseInverse().cwiseProduct(solver.eigenvectors().transpose() * right);
  for (const auto& [id, pixel] : point.pixels) {
    if (!((model.photos.at(id).cam_from_world * position).z() > 0)) return std::nullopt;
  }
  return position;
}

}  // namespace stucco
