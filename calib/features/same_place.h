// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "calib/features/features.h"
#include "calib/features/match.h"

namespace stucco {

// One place of a photo is found several times: in the photo itself, where SIFT gives a keypoint for
// each of its orientations, and on every rectified wall that shows it. Of each keypoint the index
// of the one that stands for its place. The first `num_plain` keypoints are those of the photo
// itself, of which only those at exactly the same pixel are one place; any other belongs to the
// nearest before it within `same_px` and of like size, where there is one. What stands for a place
// stands for itself: differences do not add up from one keypoint to the next.
// Requires num_plain <= keypoints.size().
std::vector<int32_t> FindPlaces(std::span<const Keypoint> keypoints, size_t num_plain,
                                double same_px);

// For the keypoints of two photos, as FindPlaces numbers them.
struct PlacesOfPair {
  std::vector<int32_t> first;
  std::vector<int32_t> second;
};

// Takes out matches that join the same places as one before them.
void DropRepeated(const PlacesOfPair& places, std::vector<Match>& matches);

// Lets matches join what stands for the places of their keypoints. Of matches that then join one
// keypoint with two of the other photo, the first stays: a track holds one keypoint of a photo.
void JoinPlaces(const PlacesOfPair& places, std::vector<Match>& matches);

}  // namespace stucco
