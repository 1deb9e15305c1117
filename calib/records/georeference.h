// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "calib/scene/scene.h"
#include "survey/captures.h"
#include "survey/georef.h"
#include "survey/plan.h"
#include "survey/pose.h"

namespace stucco {

// Local tangent frame at the mean of the photos' positions, heights included; nothing with fewer
// than three positions. Fills the position priors of the scene, whose photos have the given
// captures.
std::optional<Georef> FrameFromPositions(const std::vector<const CapturedPhoto*>& captures,
                                         Scene& scene);

// Local tangent frame at the plan's origin; nothing with fewer than three expected poses. They (in
// the frame of the plan, by photo) become the position priors of the scene: for photos that say
// nothing of where, or of how high, they were taken.
std::optional<Georef> FrameFromPlan(const PlanOrigin& origin,
                                    const std::vector<std::optional<Pose>>& expected, Scene& scene);

// What the positions tell of the frame besides the shift. Cameras on one line leave the turn about
// it open; then the gimbal has to say where up is, or nothing does.
enum class FitHolds { kEverything, kScaleAndHeading, kScale };

struct PriorFit {
  Similarity enu_from_scene;
  FitHolds holds = FitHolds::kEverything;
  std::vector<int> outliers;  // photos whose position contradicts the others
  double spread_m = 0;        // standard deviation of the camera centres across their line, metres
};

// Robust similarity from camera centres to position priors: RANSAC over triples, least squares on
// the inliers. When the cameras are so much on a line that the positions' own uncertainty leaves
// the turn about it undetermined, `up` (in the scene's frame) takes its place, and without it only
// the scale holds. Nothing when fewer than three registered photos have positions, when half of
// these contradict the others, or when they are too close together even for a scale.
std::optional<PriorFit> FitToPriors(const Scene& scene, const std::optional<Eigen::Vector3d>& up);

// Moves poses and points.
void Transform(const Similarity& new_from_old, Scene& scene);

// Direction away from the ground in the scene's frame from the gimbal's pitch and roll (yaw is not
// needed); nothing when fewer than two registered photos have gimbal angles or they disagree by
// more than 15 degrees.
std::optional<Eigen::Vector3d> UpFromGimbal(const std::vector<const CapturedPhoto*>& captures,
                                            const Scene& scene);

struct PriorResiduals {
  double rms_horizontal_m = -1;
  double rms_vertical_m = -1;
  std::vector<double> distance_m;  // per photo; -1 without pose or prior
};

// Distances between camera centres and position priors, outliers left out of the root mean squares.
PriorResiduals MeasurePriors(const Scene& scene, const std::vector<int>& outliers);

}  // namespace stucco
