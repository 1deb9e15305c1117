// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "calib/adjust/covariance.h"
#include "calib/scene/scene.h"

namespace stucco {

// A focal length whose relative standard deviation is no less is a guess.
inline constexpr double kGuessedFocal = 0.5;

// What became of one photo.
struct PlacedPhoto {
  int num_points = 0;   // keypoints whose track has a point
  int num_inliers = 0;  // of these, in agreement with the pose
  PoseSigma sigma;      // with the points taken as they are
  std::string why;      // it has no pose, for people; empty: it has one
};

// Gives the photos of a scene whose tracks have points the poses that these say, and cameras whose
// metadata are no more than a guess, or that are not held, their intrinsics. A held camera is let
// go where its photos clearly say another lens. Points stay where they are: photos are placed in a
// finished model one by one, from P3P (Resect) to least squares, and bring nothing to it. A pose
// stays only when more points agree with it than chance lets (LogFalseAlarms) and it is good to a
// pixel of the picture its keypoints were detected in. Elements that agree are `used` afterwards.
// Requires an indexed scene without poses, with models that can be adjusted. By photo.
std::vector<PlacedPhoto> PlaceInModel(Scene& scene);

}  // namespace stucco
