// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "calib/scene.h"
#include "survey/captures.h"
#include "survey/georef.h"

namespace stucco {

// Local tangent frame at the mean of the photos' positions, heights included; nothing with fewer
// than three positions. Fills the position priors of the scene, whose photos have the given
// captures.
std::optional<Georef> FrameFromPositions(const std::vector<const CapturedPhoto*>& captures,
                                         Scene& scene);

struct PriorFit {
  Similarity enu_from_scene;
  std::vector<int> outliers;  // photos whose position contradicts the others
  double spread_m = 0;        // extent of the positions across their second direction
};

// Robust similarity from camera centres to position priors: RANSAC over triples, least squares on
// the inliers. Nothing when fewer than three posed photos have positions, or when the positions are
// so close together or so much on a line that their own uncertainty leaves the frame undetermined.
std::optional<PriorFit> FitToPriors(const Scene& scene);

// Moves poses and points.
void Transform(const Similarity& new_from_old, Scene& scene);

// Direction away from the ground in the scene's frame from the gimbal's pitch and roll (yaw is not
// needed); nothing when fewer than two posed photos have gimbal angles or they disagree by more
// than 15 degrees.
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
