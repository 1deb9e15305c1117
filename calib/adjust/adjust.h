// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "calib/scene/scene.h"

namespace stucco {

// Which intrinsics an adjustment may change. Each level includes those before it.
enum class RefineIntrinsics { kNone, kFocal, kDistortion, kPrincipalPoint };

struct AdjustOptions {
  // Photos whose poses may change, by index; empty: all registered ones. The others hold the frame.
  std::vector<int> variable_photos;
  // Points are what they are, and hold the frame: only poses and intrinsics change.
  bool hold_points = false;
  // At most; a camera of which few photos take part gets less, unless points are held.
  RefineIntrinsics refine = RefineIntrinsics::kDistortion;
  // Residuals beyond this many standard deviations lose weight (Cauchy loss).
  double loss_scale = 2;
  // Positions and attitudes that the photos were recorded at, that photos of one hover stand in one
  // place, and control points; the scene must be in their frame. With control points the positions
  // may all be off together.
  bool use_priors = false;
  // Standard deviation of keypoints in units of the one they came with, against which the priors
  // weigh: 1 lets them weigh as much as it says, less lets them weigh less.
  double noise = 1;
  // The same against positions good to a decimetre, at least: lenses that are not quite as modelled
  // bend a model by centimetres, which these can hold.
  double least_noise_against_positions = 0;
  // Tracks that take part, by index; empty: all that have a point.
  std::vector<int> tracks;
  int threads = 1;  // more than one is faster but not reproducible
  int max_iterations = 50;
  double tolerance = 1e-4;  // relative change of the cost that ends the iteration
};

struct AdjustReport {
  bool usable = false;
  int num_observations = 0;
  double rms_after = -1;  // standard deviations, robust cost included
};

// Bundle adjustment (Triggs et al. 2000) of poses, points and shared intrinsics with Ceres.
// Intrinsics are held near their priors by weak Gaussian terms, so that what the photos do not
// determine stays where it was: focal length by SceneCamera::focal_sigma_ratio, principal point
// within a few per cent of the image, square pixels, small tangential distortion. Requires a
// consistent scene. Throws Error (kStageFailed) for camera models without a cost function.
AdjustReport Adjust(const AdjustOptions& options, Scene& scene);

// Robust weights for poses and points that are as rough as the tolerance that observations were
// chosen with (standard deviations of the keypoints): these weigh little against records then. Sets
// `loss_scale` and `noise`.
void WeighByTolerance(double tolerance_sigmas, AdjustOptions& options);

// Standard deviation of the keypoints per axis as their residuals show it, in units of the one they
// came with: from the median, so that wrong matches do not count. At least 0.05; 1 without points.
double MeasureNoise(const Scene& scene);

// Standard deviation of the plausibility term of parameter `i` of the camera's model, in the
// parameter's own unit, or 0 when there is none. Requires 0 <= i < number of parameters.
double PriorSigma(const SceneCamera& camera, int i);

// Standard deviation of the ratio of the two focal lengths against the prior's.
inline constexpr double kFocalRatioSigma = 0.002;

}  // namespace stucco
