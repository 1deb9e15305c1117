// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <string>

namespace stucco {

// The rotation nearest to a matrix of a file, whose digits are rounded. Throws Error (kBadInput),
// which begins with `where`, when it is none: not finite, mirrored, stretched.
Eigen::Quaterniond RotationOfMatrix(const Eigen::Matrix3d& matrix, const std::string& where);

}  // namespace stucco
