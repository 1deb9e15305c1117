// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <ceres/autodiff_cost_function.h>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "calib/adjust/internal/costs.h"

namespace stucco {

// (point - surveyed point) / sigma per axis. Blocks: point, shift of the positions. The shift has
// no part in it; but what shares no term with a point Ceres eliminates like a point, and without
// the shift all poses would hang together.
struct SurveyedPointCost {
  Eigen::Vector3d surveyed;
  Eigen::Vector3d inverse_sigma;

  template <typename T>
  bool operator()(const T* point, const T* /*shift*/, T* residual) const {
    for (int i = 0; i < 3; ++i) residual[i] = (point[i] - T(surveyed[i])) * T(inverse_sigma[i]);
    return true;
  }

  static ceres::CostFunction* Create(const Eigen::Vector3d& surveyed,
                                     const Eigen::Vector3d& sigma) {
    return new ceres::AutoDiffCostFunction<SurveyedPointCost, 3, 3, 3>(
        new SurveyedPointCost{surveyed, sigma.cwiseInverse()});
  }
};

// PositionCost where all positions may be off together: (camera centre + shift - position) / sigma.
// Blocks: pose, shift.
struct ShiftedPositionCost {
  PositionCost position;

  template <typename T>
  bool operator()(const T* pose, const T* shift, T* residual) const {
    position(pose, residual);
    for (int i = 0; i < 3; ++i) residual[i] += shift[i] * T(position.inverse_sigma[i]);
    return true;
  }

  static ceres::CostFunction* Create(const Eigen::Vector3d& position,
                                     const Eigen::Vector3d& sigma) {
    return new ceres::AutoDiffCostFunction<ShiftedPositionCost, 3, kPoseSize, 3>(
        new ShiftedPositionCost{{position, sigma.cwiseInverse()}});
  }
};

}  // namespace stucco
