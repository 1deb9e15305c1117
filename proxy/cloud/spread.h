// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "proxy/cloud/grid_index.h"

namespace stucco {

// How the points around one lie.
struct Spread {
  int count = 0;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  // all zero of no points
};

// Of the points of the index within `radius` of `center`.
Spread SpreadAround(const GridIndex& index, const Eigen::Vector3d& center, double radius);

}  // namespace stucco
