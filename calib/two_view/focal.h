// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

namespace stucco {

// A fundamental matrix between two photos of the same camera and how many matches stand behind it.
struct FocalEvidence {
  Eigen::Matrix3d fundamental = Eigen::Matrix3d::Zero();
  int num_inliers = 0;
};

// Focal length in pixels of a camera with square pixels and its principal point in the middle, from
// pairs of its photos: with the right focal length K' F K has two equal singular values (Mendonca &
// Cipolla 1999). Minimises the weighted sum over all pairs on a logarithmic scale from 0.4 to 4
// times the longer side. Nothing when the pairs do not agree on a clear minimum.
// Requires sizes above 0.
std::optional<double> FocalFromFundamentals(const std::vector<FocalEvidence>& pairs, int width_px,
                                            int height_px);

}  // namespace stucco
