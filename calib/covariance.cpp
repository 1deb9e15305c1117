// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/covariance.h"

#include <ceres/manifold.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cassert>
#include <cmath>
#include <map>
#include <memory>

#include "calib/adjust.h"
#include "calib/internal/costs.h"

namespace stucco {
namespace {

using Matrix2X = Eigen::Matrix<double, 2, Eigen::Dynamic, Eigen::RowMajor>;

struct Linearised {
  Eigen::Vector2d residual = Eigen::Vector2d::Zero();
  Matrix2X intrinsics;
  Eigen::Matrix<double, 2, 6, Eigen::RowMajor> pose;
  Eigen::Matrix<double, 2, 3, Eigen::RowMajor> point;
};

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

bool Linearise(const Scene& scene, const SceneElement& element, const Eigen::Vector3d& point,
               Linearised& out) {
  const ScenePhoto& photo = scene.photos[element.photo];
  const Camera& camera = scene.CameraOf(element.photo);
  const int num_params = static_cast<int>(camera.params.size());
  const auto cost = CostOf(camera, photo.keypoints[element.keypoint], photo.keypoint_sigma_px);
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

// Derivatives of the centre by the rotation as Ceres' manifold turns it (q' = exp(d) q, a rotation
// by twice the vector d), with the translation held.
Eigen::Matrix3d CenterByRotation(const Pose& pose) {
  const Eigen::Vector3d& t = pose.translation;
  Eigen::Matrix3d cross;
  cross << 0, -t.z(), t.y(), t.z(), 0, -t.x(), -t.y(), t.x(), 0;
  return -2 * pose.rotation.conjugate().toRotationMatrix() * cross;
}

class ReducedSystem {
 public:
  explicit ReducedSystem(const Scene& scene) : scene_(scene) {
    for (const SceneCamera& camera : scene.cameras) {
      camera_offset_.push_back(size_);
      if (camera.focal_sigma_ratio > 0) size_ += static_cast<int>(camera.intrinsics.params.size());
    }
    for (size_t i = 0; i < scene.photos.size(); ++i) {
      if (!scene.photos[i].pose) continue;
      pose_offset_[static_cast<int>(i)] = size_;
      size_ += 6;
    }
    normal_ = Eigen::MatrixXd::Zero(size_, size_);
  }

  void AddTrack(const SceneTrack& track) {
    if (!track.position) return;
    std::map<int, Eigen::MatrixXd> cross;  // offset -> block (rows of the block) x 3
    Eigen::Matrix3d point_block = Eigen::Matrix3d::Zero();
    for (const SceneElement& element : track.elements) {
      if (!element.used) continue;
      Linearised l;
      if (!Linearise(scene_, element, *track.position, l)) continue;
      squares_ += l.residual.squaredNorm();
      num_residuals_ += 2;
      const int camera = scene_.photos[element.photo].camera;
      const bool free = scene_.cameras[camera].focal_sigma_ratio > 0;
      const int pose = pose_offset_.at(element.photo);
      point_block += l.point.transpose() * l.point;
      AddBlock(pose, pose, l.pose.transpose() * l.pose);
      AddCross(cross, pose, l.pose.transpose() * l.point);
      if (!free) continue;
      const int intrinsics = camera_offset_[camera];
      AddBlock(intrinsics, intrinsics, l.intrinsics.transpose() * l.intrinsics);
      AddBlock(intrinsics, pose, l.intrinsics.transpose() * l.pose);
      AddBlock(pose, intrinsics, l.pose.transpose() * l.intrinsics);
      AddCross(cross, intrinsics, l.intrinsics.transpose() * l.point);
    }
    const Eigen::Matrix3d inverse = point_block.inverse();
    if (!inverse.allFinite()) return;
    ++num_points_;
    for (const auto& [row, a] : cross) {
      for (const auto& [col, b] : cross) AddBlock(row, col, -a * inverse * b.transpose());
    }
  }

  std::vector<Eigen::VectorXd> Solve() {
    const double redundancy = num_residuals_ - 3.0 * num_points_ - size_;
    const double variance = squares_ / std::max(1.0, redundancy);
    for (size_t c = 0; c < scene_.cameras.size(); ++c) {
      if (scene_.cameras[c].focal_sigma_ratio > 0) AddPrior(c, variance);
    }
    HoldFrame();
    const Eigen::LDLT<Eigen::MatrixXd> factors(normal_);
    if (factors.info() != Eigen::Success || !factors.isPositive()) return {};
    std::vector<Eigen::VectorXd> sigmas;
    for (size_t c = 0; c < scene_.cameras.size(); ++c) {
      const int count = static_cast<int>(scene_.cameras[c].intrinsics.params.size());
      Eigen::VectorXd sigma = Eigen::VectorXd::Zero(count);
      for (int i = 0; scene_.cameras[c].focal_sigma_ratio > 0 && i < count; ++i) {
        const int index = camera_offset_[c] + i;
        const double covariance = factors.solve(Eigen::VectorXd::Unit(size_, index))[index];
        if (!std::isfinite(covariance) || covariance <= 0) return {};
        sigma[i] = std::sqrt(covariance * variance);
      }
      sigmas.push_back(sigma);
    }
    return sigmas;
  }

 private:
  template <typename Block>
  void AddBlock(int row, int col, const Block& block) {
    normal_.block(row, col, block.rows(), block.cols()) += block;
  }

  static void AddCross(std::map<int, Eigen::MatrixXd>& cross, int offset,
                       const Eigen::MatrixXd& block) {
    const auto [it, is_new] = cross.try_emplace(offset, block);
    if (!is_new) it->second += block;
  }

  // What the adjustment assumes about the lens. The whole system is scaled by `variance` in the
  // end, which must not make these assumptions any firmer.
  void AddPrior(size_t index, double variance) {
    const SceneCamera& camera = scene_.cameras[index];
    const int offset = camera_offset_[index];
    for (int i = 0; i < static_cast<int>(camera.intrinsics.params.size()); ++i) {
      const double sigma = PriorSigma(camera, i);
      normal_(offset + i, offset + i) += variance / (sigma * sigma);
    }
    const double fx = camera.intrinsics.params[0];
    const double fy = camera.intrinsics.params[1];
    const Eigen::RowVector2d by_focal =
        Eigen::RowVector2d(-fy / (fx * fx), 1 / fx) / kFocalRatioSigma;
    AddBlock(offset, offset, variance * by_focal.transpose() * by_focal);
  }

  // First pose, and the scale by that coordinate of the farthest pose that changes most with it.
  void HoldFrame() {
    const auto& [first, first_offset] = *pose_offset_.begin();
    const double strong = normal_.diagonal().maxCoeff();
    normal_.block<6, 6>(first_offset, first_offset).diagonal().array() += strong;
    const Eigen::Vector3d origin = scene_.photos[first].pose->Center();
    double farthest = -1;
    int index = 0;
    for (const auto& [photo, offset] : pose_offset_) {
      const Eigen::Vector3d to_origin = *scene_.photos[photo].pose * origin;
      if (to_origin.norm() <= farthest) continue;
      farthest = to_origin.norm();
      int axis = 0;
      to_origin.cwiseAbs().maxCoeff(&axis);
      index = offset + 3 + axis;
    }
    normal_(index, index) += strong;
  }

  const Scene& scene_;
  int size_ = 0;
  std::vector<int> camera_offset_;
  std::map<int, int> pose_offset_;
  Eigen::MatrixXd normal_;
  double squares_ = 0;
  int num_residuals_ = 0;
  int num_points_ = 0;
};

}  // namespace

std::vector<Eigen::VectorXd> IntrinsicsSigma(const Scene& scene, int max_photos) {
  assert(IsConsistent(scene));
  const int registered = NumRegistered(scene);
  if (registered < 2 || registered > max_photos) return {};
  ReducedSystem system(scene);
  for (const SceneTrack& track : scene.tracks) system.AddTrack(track);
  return system.Solve();
}

std::vector<PoseSigma> PoseSigmas(const Scene& scene) {
  assert(IsConsistent(scene));
  using Matrix6 = Eigen::Matrix<double, 6, 6>;
  std::vector<Matrix6> normals(scene.photos.size(), Matrix6::Zero());
  for (const SceneTrack& track : scene.tracks) {
    if (!track.position) continue;
    for (const SceneElement& element : track.elements) {
      Linearised l;
      if (!element.used || !Linearise(scene, element, *track.position, l)) continue;
      normals[element.photo] += l.pose.transpose() * l.pose;
    }
  }
  const double noise = MeasureNoise(scene);
  std::vector<PoseSigma> sigmas(scene.photos.size());
  for (size_t i = 0; i < sigmas.size(); ++i) {
    if (!scene.photos[i].pose) continue;
    const Matrix6 covariance = noise * noise * normals[i].inverse();
    if (!covariance.allFinite()) continue;
    // The rotation block is of half angles (the manifold of quaternions); the centre is -R^T t.
    const Pose& pose = *scene.photos[i].pose;
    Eigen::Matrix<double, 3, 6> by_pose;
    by_pose.leftCols<3>() = CenterByRotation(pose);
    by_pose.rightCols<3>() = -pose.rotation.conjugate().toRotationMatrix();
    sigmas[i].position = std::sqrt((by_pose * covariance * by_pose.transpose()).trace());
    sigmas[i].rotation_rad = 2 * std::sqrt(covariance.topLeftCorner<3, 3>().trace());
  }
  return sigmas;
}

}  // namespace stucco
