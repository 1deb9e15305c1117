// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <string>
#include <vector>

#include "calib/adjust/adjust.h"
#include "calib/scene/scene.h"
#include "calib/two_view/initial_pair.h"
#include "survey/stage.h"

namespace stucco {

struct MapperOptions {
  double max_error_sigmas = 4;  // of reprojections, in standard deviations of the keypoints
  double min_angle_rad = 0.026;
  int min_inliers = 15;
  int max_initial_pairs = 8;
  bool refine_principal_point = true;
  int threads = 1;         // of what gives the same with any number of them
  int adjust_threads = 1;  // of bundle adjustment
  // Of each photo, at most, while a large survey is adjusted: chosen by how they cover it.
  int observations_per_photo = 400;
  // Whether the scene is in the frame of its priors, so that they take part in adjustments.
  bool use_priors = false;
};

struct MapReport {
  int num_registered = 0;
  int num_initial_pairs_tried = 0;
};

// Incremental structure from motion (Schoenberger & Frahm 2016): grows a reconstruction from the
// best initial pair by resection, triangulation and bundle adjustment, in the largest group of
// photos that overlap; when it stays small the next pair is tried, and smaller groups that are
// still larger than what was registered. The largest result is kept. Leaves poses, points and
// intrinsics in the scene, in an arbitrary frame; RefineAll makes them as good as they can be.
MapReport Reconstruct(const MapperOptions& options, const std::vector<VerifiedPair>& pairs,
                      const StageContext& context, Scene& scene);

// Grows from the photos that have a pose.
void GrowOn(const MapperOptions& options, const StageContext& context, Scene& scene);

// Why each photo without a pose has none, and what to do about it.
std::map<int, std::string> ExplainUnregistered(const MapperOptions& options,
                                               const std::vector<VerifiedPair>& pairs,
                                               const Scene& scene);

// Tracks that take part in an adjustment of everything: chosen ones of a large scene; empty: all.
std::vector<int> TracksToAdjust(const MapperOptions& options, const Scene& scene);

// Rounds of bundle adjustment of everything, filtering and triangulating anew, until nothing
// changes. With `use_priors` the scene must be in the frame of its priors, and points that cannot
// be seen are taken away (DropHiddenPoints).
void Settle(const MapperOptions& options, bool use_priors, const StageContext& context,
            Scene& scene);

// One adjustment of everything until it converges. Returns its report.
AdjustReport Converge(const MapperOptions& options, bool use_priors, const StageContext& context,
                      Scene& scene);

// Both.
AdjustReport RefineAll(const MapperOptions& options, bool use_priors, const StageContext& context,
                       Scene& scene);

// Drops observations beyond the options' largest error, points left with fewer than two or
// seen under less than the angle, and poses left with fewer than `min_inliers` observations.
// Returns the number of observations dropped.
int FilterScene(const MapperOptions& options, Scene& scene);

}  // namespace stucco
