// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <map>
#include <utility>
#include <vector>

#include "calib/calibrate.h"
#include "calib/expect/guidance.h"
#include "calib/features.h"
#include "calib/seed.h"
#include "calib/wall_features.h"
#include "survey/captures.h"
#include "survey/stage.h"

namespace stucco {

// What was found in one rectified wall.
struct WallRun {
  size_t begin = 0;  // index of the first among all keypoints of the photo
  Features features;
  std::vector<OnWall> places;
};

// Keypoints of a photo are numbered through: those found in the photo itself, then those of its
// rectified walls.
struct DetectedFeatures {
  std::vector<Features> plain;                   // by photo
  std::map<std::pair<int, int>, WallRun> walls;  // by (photo, wall)

  // Keypoints and colours of all, without descriptors.
  Features AllOf(int photo) const;
};

// The usable photos of a survey, their cameras, and what the plan says of them.
struct PhotoSet {
  const Captures& captures;
  const std::vector<const CapturedPhoto*>& photos;
  const Guidance& guidance;
};

// Features of every photo, checkpointed by content.
DetectedFeatures DetectAll(const CalibOptions& options, const PhotoSet& set,
                           const StageContext& context);

// Verified pairs among the photos, checkpointed by the content of both.
std::vector<VerifiedPair> MatchAll(const CalibOptions& options, const PhotoSet& set,
                                   const DetectedFeatures& features, const StageContext& context);

// Full-resolution pixels per pixel of the image that features are detected in.
double DetectionScale(const CalibOptions& options, const CapturedPhoto& photo);

}  // namespace stucco
