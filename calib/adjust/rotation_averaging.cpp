// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/adjust/rotation_averaging.h"

#include <ceres/autodiff_cost_function.h>
#include <ceres/loss_function.h>
#include <ceres/manifold.h>
#include <ceres/problem.h>
#include <ceres/solver.h>

#include <cassert>

#include "calib/adjust/internal/costs.h"

namespace stucco {
namespace {

constexpr double kRotationLossScale = 3;

struct RelativeCost {
  Eigen::Quaterniond second_from_first;
  double inverse_sigma;

  template <typename T>
  bool operator()(const T* first, const T* second, T* residual) const {
    const Eigen::Map<const Eigen::Quaternion<T>> a(first);
    const Eigen::Map<const Eigen::Quaternion<T>> b(second);
    WeighRotation<T>(b * (second_from_first.cast<T>() * a).conjugate(), inverse_sigma, residual);
    return true;
  }
};

}  // namespace

void AverageRotations(const std::vector<RelativeRotation>& pairs, const RotationSigmas& sigmas,
                      std::vector<std::optional<Eigen::Quaterniond>>& rotations) {
  ceres::Problem::Options problem_options;
  problem_options.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  problem_options.manifold_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ceres::CauchyLoss loss(kRotationLossScale);
  ceres::EigenQuaternionManifold manifold;
  ceres::Problem problem(problem_options);
  for (auto& rotation : rotations) {
    if (!rotation) continue;
    problem.AddResidualBlock(AttitudeCost::Create<4>(*rotation, sigmas.prior_rad), &loss,
                             rotation->coeffs().data());
    problem.SetManifold(rotation->coeffs().data(), &manifold);
  }
  for (const RelativeRotation& pair : pairs) {
    assert(rotations[pair.first] && rotations[pair.second]);
    problem.AddResidualBlock(new ceres::AutoDiffCostFunction<RelativeCost, 3, 4, 4>(
                                 new RelativeCost{pair.second_from_first, 1 / sigmas.relative_rad}),
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
