// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/match/match_graph.h"

#include <algorithm>
#include <cmath>

namespace stucco::plan {
namespace {

// Nothing matches on a surface that is seen at less.
constexpr float kLeastCosine = 0.02F;
// Where half of the features are lost. Fitted to which photos of a flown survey share points
// (bench/match_graph.py, docs/benchmarks.md).
constexpr double kHalfTilt = 3;
constexpr double kHalfScale = 4;
// Fitted likewise: what a surface has for each feature that is found again on ground, and the
// cosine of a line of sight at which half of a surface's features are lost.
constexpr float kWallFeatures = 0.65F;
constexpr float kRoofFeatures = 0.35F;
constexpr float kHalfCosine = 0.25F;

float CosineOf(const Eigen::Vector3f& normal, const Sight& sight) {
  return std::max(kLeastCosine, sight.way.dot(normal));
}

float FeaturesOf(SurfaceKind kind) {
  switch (kind) {
    case SurfaceKind::kWall:
      return kWallFeatures;
    case SurfaceKind::kRoof:
      return kRoofFeatures;
    case SurfaceKind::kGround:
      return 1;
  }
  return 0;
}

}  // namespace

float Richness(SurfaceKind kind, float cosine) {
  return FeaturesOf(kind) * cosine * cosine / (cosine * cosine + kHalfCosine * kHalfCosine);
}

// With the tangential parts t1 and t2 of the lines of sight, the pictures stretch the patch by
// G = I - t t^T; the eigenvalues of G1^-1 G2 are the squares of the stretches from one to the
// other, and the tilt is their sum and its root over twice the root of their product.
Warp WarpBetween(const Sight& one, double cosine, const Sight& other, double other_cosine) {
  const double cosines = cosine * other_cosine;
  const double t1_t2 = one.way.dot(other.way) - cosines;
  const double trace =
      1 + cosines * cosines - t1_t2 * t1_t2;  // times the first cosine squared, as root
  const double root = std::sqrt(std::max(0.0, trace * trace - 4 * cosines * cosines));
  const double size = other_cosine * one.distance_m * one.distance_m;
  const double other_size = cosine * other.distance_m * other.distance_m;
  return {(trace + root) / (2 * cosines), std::max(size, other_size) / std::min(size, other_size)};
}

double Likeness(const Warp& warp) {
  const double tilt = warp.tilt * warp.tilt / (kHalfTilt * kHalfTilt);
  const double scale = warp.scale_squared / (kHalfScale * kHalfScale);
  return 1 / ((1 + tilt * tilt) * (1 + scale * scale * scale));
}

bool IsClose(const Sight& one, const Sight& other) {
  static const float close_cosine = std::cos(kCloseAngle_rad);
  return one.way.dot(other.way) >= close_cosine &&
         one.distance_m <= kCloseRatio * other.distance_m &&
         other.distance_m <= kCloseRatio * one.distance_m;
}

// What a patch adds to the strength of a pair.
float MatchGraph::Common(const Sight& one, float cosine, const Sight& other,
                         float other_cosine) const {
  const auto likeness = static_cast<float>(Likeness(WarpBetween(one, cosine, other, other_cosine)));
  return std::min(one.share, other.share) * likeness *
         Richness(view_.samples[one.sample].kind, std::min(cosine, other_cosine));
}

float MatchGraph::CosineAt(const Sight& sight) const {
  return CosineOf(view_.samples[sight.sample].normal.cast<float>(), sight);
}

uint32_t MatchGraph::Add(const Eigen::Vector3d& position, std::vector<Sight> sights) {
  const auto photo = static_cast<uint32_t>(positions_.size());
  for (const Sight& sight : sights) {
    rays_[sight.sample].push_back({photo, CosineAt(sight), sight});
  }
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
    const float cosine = CosineAt(own);
    for (const Ray& ray : rays_[own.sample]) {
      strength[ray.photo] += Common(own, cosine, ray.sight, ray.cosine);
      if (is_wall && IsClose(own, ray.sight)) close[ray.photo] += own.share;
    }
  }
  std::vector<Partner> out;
  for (uint32_t photo = 0; photo < size(); ++photo) {
    if (!(strength[photo] > 0) || IsFrom(photo, position)) continue;
    out.push_back({photo, strength[photo], walls > 0 ? close[photo] / walls : 0});
  }
  return out;
}

float MatchGraph::StrengthBetween(uint32_t photo, std::span<const Sight> sights) const {
  float strength = 0;
  auto at = sights.begin();
  for (const Sight& own : sights_[photo]) {
    while (at != sights.end() && at->sample < own.sample) ++at;
    if (at == sights.end()) break;
    if (at->sample == own.sample) strength += Common(own, CosineAt(own), *at, CosineAt(*at));
  }
  return strength;
}

}  // namespace stucco::plan
