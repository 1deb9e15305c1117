// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/quality/facade_quality.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace stucco::plan {
namespace {

// Balancing coefficients of eq. 2.
constexpr double kLambdaS = 0.1;
constexpr double kLambdaD = 0.85;
constexpr double kLambdaU = 0.3;
constexpr double kLambdaC = 0.1;

double Frontality(const SeenPart& part) {
  return std::max(0.0, part.frontality);
}

}  // namespace

double Closeness(double distance_m, double d_min, double d_max) {
  assert(d_min < d_max);
  return std::clamp((d_max - distance_m) / (d_max - d_min), 0.0, 1.0);
}

FacadeQuality QualityOfFacade(std::span<const SeenPart> parts, double union_share, double d_min,
                              double d_max) {
  double total = 0;
  for (const SeenPart& part : parts) total += part.share;
  if (!(total > 0)) return {};
  double frontality = 0, closeness = 0, mean_distance = 0, mean_square = 0;
  Eigen::Vector3d mean_direction = Eigen::Vector3d::Zero();
  for (const SeenPart& part : parts) {
    const double weight = part.share / total;
    frontality += weight * Frontality(part);
    mean_direction += weight * part.direction;
    closeness += weight * Closeness(part.distance_m, d_min, d_max);
    mean_distance += weight * part.distance_m;
    mean_square += weight * part.distance_m * part.distance_m;
  }
  const double deviation = std::sqrt(std::max(0.0, mean_square - mean_distance * mean_distance));
  const double unevenness = mean_distance > 0 ? std::min(1.0, deviation / mean_distance) : 0;
  return {.q_s = std::min(1.0, 0.5 * (frontality + mean_direction.norm())),
          .q_d = 0.5 * (closeness + 1 - unevenness),
          .q_u = std::min(1.0, union_share / total),
          .q_c = std::min(1.0, union_share)};
}

FacadeQuality QualityOfView(const SeenPart& part, double widest_share, double d_min, double d_max) {
  assert(widest_share > 0);
  return {.q_s = Frontality(part),
          .q_d = Closeness(part.distance_m, d_min, d_max),
          .q_u = std::min(1.0, part.share / std::min(1.0, widest_share)),
          .q_c = std::min(1.0, part.share)};
}

double ViewScore(const FacadeQuality& view) {
  return kLambdaS * view.q_s + kLambdaD * view.q_d + kLambdaU * view.q_u + kLambdaC * view.q_c;
}

}  // namespace stucco::plan
