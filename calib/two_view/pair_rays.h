// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <limits>
#include <vector>

#include "calib/scene/scene.h"
#include "calib/scene/tracks.h"

namespace stucco {

// Matches of two photos as directions in their cameras' frames.
struct PairRays {
  std::vector<Eigen::Vector2d> first;  // (x/z, y/z), without distortion
  std::vector<Eigen::Vector2d> second;
  double max_error = 0;  // in units of the rays
};

// With the scene's intrinsics and places of keypoints; matches that the lens models cannot undo are
// left out. `max_error_sigmas` are standard deviations of the keypoints. Takes all matches, or
// every n-th so that they are at most `most`.
PairRays RaysOf(const Scene& scene, const PhotoPair& pair, double max_error_sigmas,
                size_t most = std::numeric_limits<size_t>::max());

}  // namespace stucco
