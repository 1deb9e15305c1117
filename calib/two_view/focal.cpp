// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/two_view/focal.h"

#include <Eigen/SVD>
#include <algorithm>
#include <cassert>
#include <cmath>

namespace stucco {
namespace {

constexpr double kSmallest = 0.4;  // times the longer side
constexpr double kLargest = 4;
constexpr int kSteps = 240;
// A clear minimum is one from which the cost rises to both sides: by this share of itself, and by
// this much per weight, at a focal length that is wrong by kAside steps (a factor of 1.4). Flights
// straight ahead, without rotation, have no such minimum.
constexpr int kAside = 35;
constexpr double kRiseShare = 0.15;
constexpr double kLeastRise = 0.0005;

// 0 for an essential matrix, 1 when the smaller of the two singular values vanishes.
double Inequality(const Eigen::Matrix3d& fundamental, double focal, const Eigen::Vector2d& center) {
  Eigen::Matrix3d k = Eigen::Matrix3d::Identity();
  k(0, 0) = k(1, 1) = focal;
  k.topRightCorner<2, 1>() = center;
  const Eigen::Matrix3d essential = k.transpose() * fundamental * k;
  const Eigen::Vector3d s = Eigen::JacobiSVD<Eigen::Matrix3d>(essential).singularValues();
  return s[0] > 0 ? (s[0] - s[1]) / (s[0] + s[1]) : 1;
}

}  // namespace

std::optional<double> FocalFromFundamentals(const std::vector<FocalEvidence>& pairs, int width_px,
                                            int height_px) {
  assert(width_px > 0 && height_px > 0);
  if (pairs.empty()) return std::nullopt;
  const double side = std::max(width_px, height_px);
  const Eigen::Vector2d center(width_px / 2.0, height_px / 2.0);
  std::vector<double> costs(kSteps + 1, 0);
  double weights = 0;
  for (const FocalEvidence& pair : pairs)
    weights += std::sqrt(static_cast<double>(pair.num_inliers));
  for (int step = 0; step <= kSteps; ++step) {
    const double focal =
        side * kSmallest * std::pow(kLargest / kSmallest, static_cast<double>(step) / kSteps);
    for (const FocalEvidence& pair : pairs) {
      // Saturated, so that degenerate pairs (planes, rotations) cannot outvote the others.
      const double cost = std::min(0.15, Inequality(pair.fundamental, focal, center));
      costs[step] += cost * std::sqrt(static_cast<double>(pair.num_inliers));
    }
  }
  const auto best = std::min_element(costs.begin(), costs.end());
  const double largest = *std::max_element(costs.begin(), costs.end());
  // At the border or in a flat valley there is no evidence.
  if (best == costs.begin() || best == costs.end() - 1 || *best > 0.9 * largest)
    return std::nullopt;
  const int index = static_cast<int>(best - costs.begin());
  const double rise =
      std::min(costs[std::max(0, index - kAside)], costs[std::min(kSteps, index + kAside)]) - *best;
  if (rise < kRiseShare * *best + kLeastRise * weights) return std::nullopt;
  const double step = index;
  return side * kSmallest * std::pow(kLargest / kSmallest, step / kSteps);
}

}  // namespace stucco
