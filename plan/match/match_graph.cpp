// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/match/match_graph.h"

#include <algorithm>
#include <cmath>

namespace stucco::plan {
namespace {

// Photos nearer to each other are taken from one place.
constexpr double kSamePlace_m = 0.5;
// Nothing matches on a surface that is seen at less.
constexpr double kLeastCosine = 0.02;
// Where half of the features are lost. Fitted to which photos of a flown survey share points
// (bench/match_graph.py, docs/benchmarks.md).
constexpr double kHalfTilt = 3;
constexpr double kHalfScale = 4;

}  // namespace

// With the tangential parts t1 and t2 of the lines of sight, the pictures stretch the patch by
// G = I - t t^T; the eigenvalues of G1^-1 G2 are the squares of the stretches from one to the
// other.
Warp WarpBetween(const Eigen::Vector3f& normal, const Sight& one, const Sight& other) {
  const double c1 = std::max<double>(kLeastCosine, one.way.dot(normal));
  const double c2 = std::max<double>(kLeastCosine, other.way.dot(normal));
  const double t1_t2 = one.way.dot(other.way) - c1 * c2;
  const double trace = 1 + c2 * c2 + (1 - c1 * c1 - t1_t2 * t1_t2) / (c1 * c1);
  const double determinant = c2 * c2 / (c1 * c1);
  const double root = std::sqrt(std::max(0.0, trace * trace - 4 * determinant));
  const double tilt = std::sqrt((trace + root) / std::max(1e-12, trace - root));
  const double scale = std::sqrt(c2 / c1) * one.distance_m / other.distance_m;
  return {tilt, std::max(scale, 1 / scale)};
}

double Likeness(const Warp& warp) {
  const double tilt_square = std::pow(warp.tilt / kHalfTilt, 2);
  const double scale_square = std::pow(warp.scale / kHalfScale, 2);
  return 1 / ((1 + tilt_square * tilt_square) * (1 + std::pow(scale_square, 3)));
}

bool IsClose(const Sight& one, const Sight& other) {
  static const float close_cosine = std::cos(kCloseAngle_rad);
  const float ratio =
      std::max(one.distance_m / other.distance_m, other.distance_m / one.distance_m);
  return one.way.dot(other.way) >= close_cosine && ratio <= kCloseRatio;
}

uint32_t MatchGraph::Add(const Eigen::Vector3d& position, std::vector<Sight> sights) {
  const auto photo = static_cast<uint32_t>(positions_.size());
  for (const Sight& sight : sights) rays_[sight.sample].push_back({photo, sight});
  positions_.push_back(position);
  sights_.push_back(std::move(sights));
  return photo;
}

std::vector<Partner> MatchGraph::PartnersOf(const Eigen::Vector3d& position,
                                            std::span<const Sight> sights) const {
  std::vector<float> strength(size(), 0.0F), close(size(), 0.0F);
  float walls = 0;
  for (const Sight& own : sights) {
    const bool is_wall = view_.samples[own.sample].kind == SurfaceKind::kWall;
    if (is_wall) walls += own.share;
    const Eigen::Vector3f normal = view_.samples[own.sample].normal.cast<float>();
    for (const Ray& ray : rays_[own.sample]) {
      const Sight& other = ray.sight;
      strength[ray.photo] += std::min(own.share, other.share) *
                             static_cast<float>(Likeness(WarpBetween(normal, own, other)));
      if (is_wall && IsClose(own, other)) close[ray.photo] += own.share;
    }
  }
  std::vector<Partner> out;
  for (uint32_t photo = 0; photo < size(); ++photo) {
    if (!(strength[photo] > 0)) continue;
    if ((positions_[photo] - position).norm() < kSamePlace_m) continue;
    out.push_back({photo, strength[photo], walls > 0 ? close[photo] / walls : 0});
  }
  return out;
}

}  // namespace stucco::plan
