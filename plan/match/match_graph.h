// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "plan/camera/photo_sights.h"

namespace stucco::plan {

// How a surface looks from two places: what an affine map from one picture to the other does to it.
struct Warp {
  double tilt = 1;           // ratio of its two stretches, at least 1: the transition tilt
  double scale_squared = 1;  // their product, at least 1 (either way)
};

// Of a patch that the lines of sight, unit vectors to the cameras, see at these cosines. Morel and
// Yu, "ASIFT: A New Framework for Fully Affine Invariant Image Comparison" (2009), section 2: two
// oblique views may differ by far more than the angle between them.
Warp WarpBetween(const Sight& one, double cosine, const Sight& other, double other_cosine);

// How surely features of a patch match: 1 where they do, towards 0 where they do not.
double Likeness(const Warp& warp);

// How many features a surface offers that is seen at this cosine at the flattest, next to level
// ground seen from straight above: roofs are plain or repeat their tiles, facades their windows.
float Richness(SurfaceKind kind, float cosine);

// What a pair of photos has in common.
struct Partner {
  uint32_t photo = 0;
  // Of the two frames, what both show alike: the smaller share of each common patch, times how
  // surely it matches and how rich in features it is; in [0, 1].
  float strength = 0;
  // Of the walls in the photo that asks, the share that this one shows within kCloseAngle_rad and
  // kCloseRatio.
  float close_walls = 0;
};

// A pair with less is not counted on. Of those with up to twice as much, nine in ten came to share
// 15 points or more, of stronger ones all (bench/match_graph.py, docs/benchmarks.md).
inline constexpr float kEnoughStrength = 0.06F;
// What a photo of a facade needs two partners within (SIFT on planes: Mikolajczyk et al., "A
// Comparison of Affine Region Detectors", 2005), for this share of the walls that it shows.
inline constexpr float kCloseAngle_rad = 0.611F;  // 35 degrees
inline constexpr float kCloseRatio = 2.5F;
inline constexpr float kCloseShare = 0.3F;
// Photos nearer to each other are taken from one place.
inline constexpr double kSamePlace_m = 0.5;

// Two photos show a sample near in direction and scale.
bool IsClose(const Sight& one, const Sight& other);

// Which photos of a plan should match, and how well. Photos from one place share no parallax and
// are no partners.
class MatchGraph {
 public:
  explicit MatchGraph(const SurfaceView& view) : view_(view), rays_(view.samples.size()) {}

  // Returns its number: they count up from 0.
  uint32_t Add(const Eigen::Vector3d& position, std::vector<Sight> sights);

  size_t size() const { return sights_.size(); }
  const Eigen::Vector3d& position(uint32_t photo) const { return positions_[photo]; }
  std::span<const Sight> sights(uint32_t photo) const { return sights_[photo]; }

  // All photos of the graph that a photo there would share something with, ascending. Safe to ask
  // from several threads.
  std::vector<Partner> PartnersOf(const Eigen::Vector3d& position,
                                  std::span<const Sight> sights) const;
  std::vector<Partner> PartnersOf(uint32_t photo) const {
    return PartnersOf(positions_[photo], sights_[photo]);
  }
  // Those of the photos that `wanted` says, from another place than this, which show any of these
  // samples, ascending.
  template <typename Wanted>
  std::vector<uint32_t> PhotosThatShow(const Eigen::Vector3d& position,
                                       std::span<const Sight> sights, const Wanted& wanted) const {
    std::vector<uint32_t> out;
    for (const Sight& sight : sights) {
      for (const Ray& ray : rays_[sight.sample]) {
        if (wanted(ray.photo)) out.push_back(ray.photo);
      }
    }
    std::ranges::sort(out);
    out.erase(std::unique(out.begin(), out.end()), out.end());
    std::erase_if(out, [&](uint32_t photo) { return IsFrom(photo, position); });
    return out;
  }
  // The strength of one pair: of a photo of the graph, and one that sees this.
  float StrengthBetween(uint32_t photo, std::span<const Sight> sights) const;

 private:
  struct Ray {
    uint32_t photo;
    float cosine;  // of the line of sight with the sample's normal
    Sight sight;
  };
  float CosineAt(const Sight& sight) const;
  float Common(const Sight& one, float cosine, const Sight& other, float other_cosine) const;
  bool IsFrom(uint32_t photo, const Eigen::Vector3d& position) const {
    return (positions_[photo] - position).norm() < kSamePlace_m;
  }

  const SurfaceView& view_;
  std::vector<Eigen::Vector3d> positions_;
  std::vector<std::vector<Sight>> sights_;  // by photo
  std::vector<std::vector<Ray>> rays_;      // by sample
};

}  // namespace stucco::plan
