// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <ceres/autodiff_cost_function.h>
#include <ceres/sized_cost_function.h>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace stucco {

// Derivatives of a pixel by the ray (x, y) and by the intrinsics.
template <int kNumParams>
struct PixelJacobians {
  Eigen::Matrix2d by_ray;
  Eigen::Matrix<double, 2, kNumParams, Eigen::RowMajor> by_intrinsics;
};

// Ray (x/z, y/z) -> pixel for PINHOLE (4 parameters), OPENCV (8) and FULL_OPENCV (12), in the
// parameter order of survey/camera.h. `jacobians` may be null.
template <int kNumParams>
Eigen::Vector2d DistortRay(const double* params, double x, double y,
                           PixelJacobians<kNumParams>* jacobians) {
  const Eigen::Array2d focal(params[0], params[1]);
  const Eigen::Vector2d ray(x, y);
  Eigen::Vector2d distorted = ray;
  Eigen::Matrix2d by_ray = Eigen::Matrix2d::Identity();
  if (jacobians != nullptr) jacobians->by_intrinsics.setZero();
  if constexpr (kNumParams >= 8) {
    const double r2 = x * x + y * y;
    const double r4 = r2 * r2;
    const double r6 = r4 * r2;
    double numerator = 1 + r2 * params[4] + r4 * params[5];
    double numerator_by_r2 = params[4] + 2 * r2 * params[5];
    double denominator = 1;
    double denominator_by_r2 = 0;
    if constexpr (kNumParams == 12) {
      numerator += r6 * params[8];
      numerator_by_r2 += 3 * r4 * params[8];
      denominator += r2 * params[9] + r4 * params[10] + r6 * params[11];
      denominator_by_r2 = params[9] + 2 * r2 * params[10] + 3 * r4 * params[11];
    }
    const double radial = numerator / denominator;
    const double radial_by_r2 = (numerator_by_r2 - radial * denominator_by_r2) / denominator;
    const Eigen::Vector2d by_p1(2 * x * y, r2 + 2 * y * y);
    const Eigen::Vector2d by_p2(r2 + 2 * x * x, 2 * x * y);
    distorted = ray * radial + params[6] * by_p1 + params[7] * by_p2;
    if (jacobians != nullptr) {
      by_ray = radial * Eigen::Matrix2d::Identity() + 2 * radial_by_r2 * ray * ray.transpose();
      const double mixed = 2 * (params[6] * x + params[7] * y);
      by_ray += Eigen::Matrix2d{{2 * params[6] * y + 6 * params[7] * x, mixed},
                                {mixed, 6 * params[6] * y + 2 * params[7] * x}};
      auto& by_intrinsics = jacobians->by_intrinsics;
      by_intrinsics.col(4) = focal * (ray * (r2 / denominator)).array();
      by_intrinsics.col(5) = focal * (ray * (r4 / denominator)).array();
      by_intrinsics.col(6) = focal * by_p1.array();
      by_intrinsics.col(7) = focal * by_p2.array();
      if constexpr (kNumParams == 12) {
        by_intrinsics.col(8) = focal * (ray * (r6 / denominator)).array();
        by_intrinsics.col(9) = focal * (ray * (-radial * r2 / denominator)).array();
        by_intrinsics.col(10) = focal * (ray * (-radial * r4 / denominator)).array();
        by_intrinsics.col(11) = focal * (ray * (-radial * r6 / denominator)).array();
      }
    }
  }
  if (jacobians != nullptr) {
    jacobians->by_ray = focal.matrix().asDiagonal() * by_ray;
    jacobians->by_intrinsics(0, 0) = distorted.x();
    jacobians->by_intrinsics(1, 1) = distorted.y();
    jacobians->by_intrinsics(0, 2) = 1;
    jacobians->by_intrinsics(1, 3) = 1;
  }
  return {params[0] * distorted.x() + params[2], params[1] * distorted.y() + params[3]};
}

// A pose as a block of Ceres: quaternion of cam_from_world (x y z w, as Eigen keeps it) and
// translation.
inline constexpr int kPoseSize = 7;

// (projected point - keypoint) / sigma. Blocks: intrinsics, pose, point. The derivatives are
// written out because an adjustment spends much of its time here.
template <int kNumParams>
class ReprojectionCost final : public ceres::SizedCostFunction<2, kNumParams, kPoseSize, 3> {
 public:
  ReprojectionCost(const Eigen::Vector2d& keypoint, double sigma)
      : keypoint_(keypoint), inverse_sigma_(1 / sigma) {}

  bool Evaluate(const double* const* blocks, double* residual, double** jacobians) const override {
    const Eigen::Map<const Eigen::Quaterniond> rotation(blocks[1]);
    const Eigen::Map<const Eigen::Vector3d> translation(blocks[1] + 4);
    const Eigen::Map<const Eigen::Vector3d> world(blocks[2]);
    const Eigen::Vector3d p = rotation * world + translation;
    if (p.z() < 1e-9) return false;
    const double x = p.x() / p.z();
    const double y = p.y() / p.z();
    PixelJacobians<kNumParams> pixel_jacobians;
    const Eigen::Vector2d pixel =
        DistortRay<kNumParams>(blocks[0], x, y, jacobians == nullptr ? nullptr : &pixel_jacobians);
    Eigen::Vector2d::Map(residual) = inverse_sigma_ * (pixel - keypoint_);
    if (jacobians == nullptr) return true;
    if (jacobians[0] != nullptr) {
      Map<kNumParams>(jacobians[0]) = inverse_sigma_ * pixel_jacobians.by_intrinsics;
    }
    Eigen::Matrix<double, 2, 3> by_p;
    by_p.leftCols<2>() = pixel_jacobians.by_ray * (inverse_sigma_ / p.z());
    by_p.col(2) = -(by_p.col(0) * x + by_p.col(1) * y);
    if (jacobians[1] != nullptr) {
      Map<kPoseSize>(jacobians[1]).template leftCols<4>() =
          by_p * RotatedByQuaternion(rotation, world);
      Map<kPoseSize>(jacobians[1]).template rightCols<3>() = by_p;
    }
    if (jacobians[2] != nullptr) Map<3>(jacobians[2]) = by_p * rotation.toRotationMatrix();
    return true;
  }

 private:
  template <int kCols>
  static auto Map(double* values) {  // NOLINT(readability-non-const-parameter): it is written to
    return Eigen::Map<Eigen::Matrix<double, 2, kCols, Eigen::RowMajor>>(values);
  }

  // Of v + 2 w (u x v) + 2 u x (u x v), with the quaternion's vector part u and scalar w.
  static Eigen::Matrix<double, 3, 4> RotatedByQuaternion(const Eigen::Quaterniond& rotation,
                                                         const Eigen::Vector3d& v) {
    const Eigen::Vector3d u = rotation.vec();
    Eigen::Matrix3d cross;
    cross << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
    Eigen::Matrix<double, 3, 4> result;
    result.leftCols<3>() = 2 * (u.dot(v) * Eigen::Matrix3d::Identity() + u * v.transpose() -
                                2 * v * u.transpose() - rotation.w() * cross);
    result.col(3) = 2 * u.cross(v);
    return result;
  }

  Eigen::Vector2d keypoint_;
  double inverse_sigma_;
};

// The camera's centre of a pose's block.
template <typename T>
Eigen::Matrix<T, 3, 1> CenterOf(const T* pose) {
  const Eigen::Map<const Eigen::Quaternion<T>> q(pose);
  const Eigen::Map<const Eigen::Matrix<T, 3, 1>> t(pose + 4);
  return -(q.conjugate() * t);
}

// (camera centre - measured position) / sigma per axis; sigma is (east, north, up).
struct PositionCost {
  Eigen::Vector3d position;
  Eigen::Vector3d inverse_sigma;

  template <typename T>
  bool operator()(const T* pose, T* residual) const {
    const Eigen::Matrix<T, 3, 1> center = CenterOf(pose);
    for (int i = 0; i < 3; ++i) residual[i] = (center[i] - T(position[i])) * T(inverse_sigma[i]);
    return true;
  }

  static ceres::CostFunction* Create(const Eigen::Vector3d& position,
                                     const Eigen::Vector3d& sigma) {
    return new ceres::AutoDiffCostFunction<PositionCost, 3, kPoseSize>(
        new PositionCost{position, sigma.cwiseInverse()});
  }
};

// (difference of two camera centres) / sigma. Blocks: the poses.
struct SamePlaceCost {
  double inverse_sigma;

  template <typename T>
  bool operator()(const T* first, const T* second, T* residual) const {
    Eigen::Map<Eigen::Matrix<T, 3, 1>> out(residual);
    out = (CenterOf(first) - CenterOf(second)) * T(inverse_sigma);
    return true;
  }

  static ceres::CostFunction* Create(double sigma) {
    return new ceres::AutoDiffCostFunction<SamePlaceCost, 3, kPoseSize, kPoseSize>(
        new SamePlaceCost{1 / sigma});
  }
};

// Twice the vector part of the quaternion: the rotation vector, short of it by the third order.
template <typename T>
void WeighRotation(const Eigen::Quaternion<T>& rotation, double inverse_sigma, T* residual) {
  const T twice = rotation.w() < T(0) ? T(-2) : T(2);
  for (int i = 0; i < 3; ++i) residual[i] = twice * rotation.vec()[i] * T(inverse_sigma);
}

// Rotation from the recorded to the estimated rotation, in the camera's frame, over sigma. The
// parameters begin with the rotation; what follows it takes no part.
struct AttitudeCost {
  Eigen::Quaterniond world_from_recorded;
  double inverse_sigma;

  template <typename T>
  bool operator()(const T* pose, T* residual) const {
    const Eigen::Map<const Eigen::Quaternion<T>> q(pose);
    WeighRotation<T>(q * world_from_recorded.cast<T>(), inverse_sigma, residual);
    return true;
  }

  // Of a block of this many parameters.
  template <int kSize>
  static ceres::CostFunction* Create(const Eigen::Quaterniond& cam_from_world, double sigma_rad) {
    return new ceres::AutoDiffCostFunction<AttitudeCost, 3, kSize>(
        new AttitudeCost{cam_from_world.conjugate(), 1 / sigma_rad});
  }
};

// Holds intrinsics near what is plausible for a lens: (parameter - expected) / sigma for each, and
// the ratio of the two focal lengths near 1.
template <int kNumParams>
struct IntrinsicsPriorCost {
  Eigen::Matrix<double, kNumParams, 1> expected;
  Eigen::Matrix<double, kNumParams, 1> inverse_sigma;  // 0: no opinion
  double inverse_aspect_sigma;
  double aspect;

  template <typename T>
  bool operator()(const T* intrinsics, T* residual) const {
    for (int i = 0; i < kNumParams; ++i) {
      residual[i] = (intrinsics[i] - T(expected[i])) * T(inverse_sigma[i]);
    }
    residual[kNumParams] = (intrinsics[1] / intrinsics[0] - T(aspect)) * T(inverse_aspect_sigma);
    return true;
  }
};

}  // namespace stucco
