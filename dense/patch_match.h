// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <vector>

#include "dense/view.h"
#include "survey/depth_map.h"

namespace stucco {

// A sparse point as the reference photo sees it, in pixels of level 0.
struct DepthSeed {
  float x = 0;
  float y = 0;
  float depth = 0;
};

struct PatchMatchOptions {
  int iterations = 1;  // at every level but the coarsest, which does more
  int views_per_pixel = 3;
  float min_depth = 0;
  float max_depth = 0;
  uint32_t seed = 0;
};

struct PatchMatchInput {
  std::shared_ptr<const ViewPyramid> reference;
  std::vector<std::shared_ptr<const ViewPyramid>> sources;
  std::vector<DepthSeed> seeds;
  // Second pass: the reference's own map and the sources' maps of the first pass (level 0); the
  // depths are then also held against each other. Empty in the first pass.
  const DepthMap* start = nullptr;
  std::vector<const DepthMap*> source_maps;
  std::function<void()> check_cancelled = [] {};
};

// Depth and normal per pixel by PatchMatch stereo with slanted planes (Bleyer et al. 2011),
// checkerboard propagation (Galliani et al. 2015, Xu & Tao 2019), per pixel the best few sources,
// coarse to fine; planes are refined by damped Gauss-Newton steps (as least squares matching does,
// Gruen 1985) in inverse depth and its slopes. Every pixel draws its random numbers from its own
// position, so that the result does not depend on the order of work.
DepthMap MatchDepths(const PatchMatchInput& input, const PatchMatchOptions& options);

}  // namespace stucco
