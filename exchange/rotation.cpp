// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "exchange/rotation.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <Eigen/SVD>

#include "survey/error.h"

namespace stucco {

Eigen::Quaterniond RotationOfMatrix(const Eigen::Matrix3d& matrix, const std::string& where) {
  // Files have four digits or more.
  constexpr double kTolerance = 1e-3;
  const Eigen::Matrix3d rest = matrix * matrix.transpose() - Eigen::Matrix3d::Identity();
  if (!(rest.cwiseAbs().maxCoeff() < kTolerance) || !(matrix.determinant() > 0)) {
    throw Error(ErrorKind::kBadInput, fmt::format("{}: its matrix is no rotation", where),
                "export the poses again");
  }
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(matrix, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Eigen::Matrix3d nearest = svd.matrixU() * svd.matrixV().transpose();
  return Eigen::Quaterniond(nearest).normalized();
}

}  // namespace stucco
