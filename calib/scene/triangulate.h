// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <optional>

#include "calib/scene/scene.h"
#include "survey/pose.h"

namespace stucco {

// The point where two rays come closest (in the frame of the first camera), or nothing when it lies
// behind either camera or the rays are parallel. Rays are (x/z, y/z).
std::optional<Eigen::Vector3d> TriangulateTwoRays(const Eigen::Vector2d& first,
                                                  const Eigen::Vector2d& second,
                                                  const Pose& second_from_first);

struct TriangulateOptions {
  double max_error_sigmas = 4;  // standard deviations of the keypoints
  double min_angle_rad = 0.026;
};

// Finds a track's point from the photos that have a pose: the two-ray point that most elements
// agree with, refined by least squares over them (Gauss-Newton on reprojection errors). Sets
// `position` and every element's `used`. Returns false, and leaves the track without a point, when
// fewer than two elements agree or all rays are nearly parallel.
bool TriangulateTrack(const Scene& scene, const TriangulateOptions& options, SceneTrack& track);

// Takes a track's point away.
void ClearPoint(SceneTrack& track);

}  // namespace stucco
