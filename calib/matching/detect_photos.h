// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "calib/features/features.h"
#include "calib/features/wall_features.h"
#include "calib/matching/photo_set.h"
#include "calib/options/calib_options.h"
#include "survey/captures.h"
#include "survey/stage.h"

namespace stucco {

// What is needed to detect features.
struct DetectInput {
  const CalibOptions& options;
  const PhotoSet& set;
  const StageContext& context;
};

// What was found in one rectified wall.
struct WallRun {
  size_t begin = 0;  // index of the first among all keypoints of the photo
  Features features;
  std::vector<OnWall> places;
};

// Keypoints of a photo are numbered through: those found in the photo itself, then those of its
// rectified walls.
// Descriptors are left out where all of them would take too much memory; FeaturesOfPhoto and
// FeaturesOnWall read them again.
struct DetectedFeatures {
  std::vector<Features> plain;                   // by photo
  std::map<std::pair<int, int>, WallRun> walls;  // by (photo, wall)

  // Keypoints and colours of all, without descriptors.
  Features AllOf(int photo) const;
};

// Features of every photo, checkpointed by content.
DetectedFeatures DetectAll(const CalibOptions& options, const PhotoSet& set,
                           const StageContext& context);

void DropDescriptors(DetectedFeatures& detected);

// With descriptors, which come from the checkpoint where they were left out.
Features FeaturesOfPhoto(const DetectInput& input, const DetectedFeatures& detected, int photo);
Features FeaturesOnWall(const DetectInput& input, const DetectedFeatures& detected, int photo,
                        int wall);

// By photo and keypoint: the keypoint that stands for its place (FindPlaces). What a rectified wall
// shows where the photo itself shows it too is one place, and so are the finds of several walls.
std::vector<std::vector<int32_t>> PlacesOfAll(const CalibOptions& options, const PhotoSet& set,
                                              const DetectedFeatures& detected);

// Pixels of the full photo within which keypoints are one place.
double SamePlace_px(const CalibOptions& options, const CapturedPhoto& photo);

// Full-resolution pixels per pixel of the image that features are detected in.
double DetectionScale(const CalibOptions& options, const CapturedPhoto& photo);

// Keys of what is kept of a photo and of one of its walls: they hash all that it depends on.
std::string FeaturesKey(const CalibOptions& options, const CapturedPhoto& photo);
std::string WallKey(const CalibOptions& options, const PhotoSet& set, int photo, int wall);

}  // namespace stucco
