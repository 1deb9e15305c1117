// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <string>
#include <vector>

#include "calib/matching/detect_photos.h"
#include "calib/matching/match_photos.h"
#include "calib/results/summary_input.h"

namespace stucco {

// How many keypoints a photo has.
struct KeypointCounts {
  size_t plain = 0;
  size_t on_walls = 0;    // found on rectified walls besides
  size_t coincident = 0;  // of these, at the place of one that the photo itself gave
};

// By photo; places as PlacesOfAll gives them.
std::vector<KeypointCounts> CountKeypoints(const DetectedFeatures& detected,
                                           std::span<const std::vector<int32_t>> places);

// What was there to place the photos by.
struct PhotoEvidence {
  std::span<const KeypointCounts> keypoints;  // by photo of the scene
  std::span<const TriedPair> tried;
  std::span<const VerifiedPair> used;  // those left when pairs that contradict the plan are gone
};

// calib/photos.csv (docs/formats.md): where each photo lost what would have given it a pose. In the
// order of the captures; those that could not be used have no figures.
std::string PhotosCsv(const SummaryInput& summary, const PhotoEvidence& evidence);

}  // namespace stucco
