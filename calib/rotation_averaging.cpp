// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/rotation_averaging.h"

#include <ceres/autodiff_cost_function.h>
#include <ceres/loss_function.h>
#include <ceres/manifold.h>
#include <ceres/problem.h>
#include <ceres/solver.h>

#include <cassert>

namespace stucco {
namespace {

constexpr double kLossScale = 3;

// Rotation vector between two rotations over sigma, to the third order.
template <typename T>
void Between(const Eigen::Quaternion<T>& from, const Eigen::Quaternion<T>& to, double sigma,
             T* residual) {
  const Eigen::Quaternion<T> between = to * from.conjugate();
  const T twice = between.w() < T(0) ? T(-2 / sigma) : T(2 / sigma);
  for (int i = 0; i < 3; ++i) residual[i] = twice * between.vec()[i];
}

struct RelativeCost {
  Eigen::Quaterniond second_from_first;
  double sigma;

  template <typename T>
  bool operator()(const T* first, const T* second, T* residual) const {
    const Eigen::Map<const Eigen::Quaternion<T>> a(first);
    const Eigen::Map<const Eigen::Quaternion<T>> b(second);
    Between<T>(second_from_first.cast<T>() * a, b, sigma, residual);
    return true;
  }
};

struct OwnCost {
  Eigen::Quaterniond expected;
  double sigma;

  template <typename T>
  bool operator()(const T* rotation, T* residual) const {
    const Eigen::Map<const Eigen::Quaternion<T>> q(rotation);
    Between<T>(expected.cast<T>(), q, sigma, residual);
    return true;
  }
};

}  // namespace

void AverageRotations(const std::vector<RelativeRotation>& pairs, const RotationSigmas& sigmas,
                      std::vector<std::optional<Eigen::Quaterniond>>& rotations) {
  ceres::Problem::Options problem_options;
  problem_options.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  problem_options.manifold_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ceres::CauchyLoss loss(kLossScale);
  ceres::EigenQuaternionManifold manifold;
  ceres::Problem problem(problem_options);
  for (auto& rotation : rotations) {
    if (!rotation) continue;
    problem.AddResidualBlock(
        new ceres::AutoDiffCostFunction<OwnCost, 3, 4>(new OwnCost{*rotation, sigmas.prior_rad}),
        &loss, rotation->coeffs().data());
    problem.SetManifold(rotation->coeffs().data(), &manifold);
  }
  for (const RelativeRotation& pair : pairs) {
    assert(rotations[pair.first] && rotations[pair.second]);
    problem.AddResidualBlock(new ceres::AutoDiffCostFunction<RelativeCost, 3, 4, 4>(
                                 new RelativeCost{pair.second_from_first, sigmas.relative_rad}),
                             &loss, rotations[pair.first]->coeffs().data(),
                             rotations[pair.second]->coeffs().data());
  }
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
  options.logging_type = ceres::SILENT;
  options.max_num_iterations = 50;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  for (auto& rotation : rotations) {
    if (rotation) rotation->normalize();
  }
}

}  // namespace stucco
