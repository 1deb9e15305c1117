// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "calib/control/ground_control.h"
#include "calib/scene/scene.h"

namespace stucco {

// Standard deviation of a mark that somebody set by hand: people hit the middle of a target to
// about a pixel of the photo.
inline constexpr double kMarkSigma_px = 1;

// A marked point as the photos' poses place it, by its marks alone.
struct MeasuredPoint {
  std::optional<Eigen::Vector3d> position;               // in the scene's frame
  std::string why_not;                                   // where there is none, for users
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  // from kMarkSigma_px
  std::vector<PhotoMark> used;                           // marks that agree with the position
  std::vector<PhotoMark> refused;                        // marks in photos with a pose that do not
  double reprojection_error_px = 0;                      // root mean square of the used ones
  double ground_pixel = 0;  // what a pixel covers at the point, mean of the used photos
};

// The points that most of their marks agree on, to ten pixels; a point needs two photos that see it
// under `min_angle_rad`.
std::vector<MeasuredPoint> MeasurePoints(const Scene& scene, std::span<const MarkedPoint> points,
                                         double min_angle_rad);

}  // namespace stucco
