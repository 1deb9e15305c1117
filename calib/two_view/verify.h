// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "calib/features/match.h"
#include "survey/camera.h"
#include "survey/pose.h"

namespace stucco {

// Both cameras, where the metadata know their focal lengths.
struct PairCameras {
  Camera first;
  Camera second;
  double focal_sigma_ratio = 0.1;  // one standard deviation of the focal lengths, relative
};

struct VerifyOptions {
  double max_error_px = 4;  // full-resolution pixels
  int min_inliers = 15;
  int seed = 0;
  std::optional<PairCameras> cameras = std::nullopt;
};

// Matches of two photos that one epipolar geometry or one homography explains.
struct PairGeometry {
  std::vector<Match> inliers;
  Eigen::Matrix3d fundamental = Eigen::Matrix3d::Zero();  // x2' F x1 = 0, full-resolution pixels
  int num_fundamental = 0;                                // matches that agree with F
  int num_homography =
      0;  // matches that agree with the best homography (a plane, or a pure rotation)
};

// Robust fundamental matrix (USAC, MAGSAC++ score, Barath et al. 2020) and homography. Nothing when
// fewer than min_inliers matches agree with either, or no more than chance lets agree
// (LogFalseAlarms), or when they lie on epipolar lines but anywhere along them, as matches of rows
// that look alike do. On a plane F takes any epipole: what F alone explains stays when the
// essential matrix explains it too, or, without cameras, more than chance lets. Requires matches of
// the given points, which are all that each photo has.
std::optional<PairGeometry> VerifyPair(const std::vector<Eigen::Vector2d>& first,
                                       const std::vector<Eigen::Vector2d>& second,
                                       const std::vector<Match>& matches,
                                       const VerifyOptions& options);

// Checkpoint format of matches and geometry; an empty optional is a pair that was refused.
std::string Serialize(const std::optional<PairGeometry>& pair);
std::optional<PairGeometry> DeserializePair(std::string_view bytes);

struct RelativePose {
  Pose second_from_first;  // unit baseline
  int num_inliers = 0;
  double median_angle_rad = 0;  // between the rays of the inliers
};

// Both of these require as many rays of the first photo as of the second.

// Essential matrix from rays (x/z, y/z) by USAC, decomposed with the cheirality test. `max_error`
// is in units of the rays. Nothing when fewer than 8 rays agree.
std::optional<RelativePose> EstimateRelativePose(const std::vector<Eigen::Vector2d>& first,
                                                 const std::vector<Eigen::Vector2d>& second,
                                                 double max_error);

// The rotation that explains most of the rays when both photos were taken from one point: RANSAC
// over pairs of rays, refined on its inliers (Kabsch). Returns the number of rays within
// `max_error`.
int CountRotationInliers(const std::vector<Eigen::Vector2d>& first,
                         const std::vector<Eigen::Vector2d>& second, double max_error, int seed);

}  // namespace stucco
