// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/cloud/spread.h"

namespace stucco {

Spread SpreadAround(const GridIndex& index, const Eigen::Vector3d& center, double radius) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
  Spread spread;
  index.ForEachNear(center, radius, [&](int j) {
    const Eigen::Vector3d d = index.point(j) - center;
    sum += d;
    squares += d * d.transpose();
    ++spread.count;
  });
  const int n = spread.count;
  if (n > 0) spread.covariance = squares / n - sum * sum.transpose() / (n * n);
  return spread;
}

}  // namespace stucco
