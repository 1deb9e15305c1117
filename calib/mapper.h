// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <string>
#include <vector>

#include "calib/scene.h"
#include "calib/seed.h"
#include "survey/stage.h"

namespace stucco {

struct MapperOptions {
  double max_misfit = 4;  // standard deviations of the keypoints
  double min_angle_rad = 0.026;
  int min_inliers = 15;
  int max_seeds = 8;
  bool refine_principal_point = true;
  int threads = 1;  // of the bundle adjustment
};

struct MapReport {
  int num_posed = 0;
  int num_seeds_tried = 0;
  std::map<int, std::string> unposed;  // photo -> why
};

// Incremental structure from motion (Schoenberger & Frahm 2016): grows a reconstruction from the
// best seed by resection, triangulation and bundle adjustment, in the largest group of photos that
// overlap; when it stays small the next seed is tried, and smaller groups that are still larger
// than what was placed. The largest result is kept. Leaves poses, points and intrinsics in the
// scene, in an arbitrary frame; RefineAll makes them as good as they can be.
MapReport Reconstruct(const MapperOptions& options, const std::vector<VerifiedPair>& pairs,
                      const StageContext& context, Scene& scene);

// Why each photo without a pose has none, and what to do about it.
std::map<int, std::string> ExplainUnposed(const MapperOptions& options,
                                          const std::vector<VerifiedPair>& pairs,
                                          const Scene& scene);

// Rounds of bundle adjustment of everything, filtering and triangulating anew, until nothing
// changes, then one until it converges. With `use_priors` the scene must be in the frame of its
// position priors. Returns the last adjustment's report.
struct AdjustReport RefineAll(const MapperOptions& options, bool use_priors,
                              const StageContext& context, Scene& scene);

// Drops observations beyond `max_misfit` standard deviations, points left with fewer than two or
// seen under less than the angle, and poses left with fewer than `min_inliers` observations.
// Returns the number of observations dropped.
int FilterScene(const MapperOptions& options, double max_misfit, Scene& scene);

}  // namespace stucco
