// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "calib/features/features.h"
#include "survey/reconstruction.h"

namespace stucco {

// By keypoint: the point of the reconstruction whose observation in this image is nearest to it,
// within `reach_px`; invalid where there is none. Keypoints need not be those that the
// reconstruction was made from.
std::vector<PointId> PointsOfKeypoints(const std::vector<Keypoint>& keypoints,
                                       const RegisteredImage& image, double reach_px);

// A keypoint of a photo and the point that it is said to show, by one match.
struct PointVote {
  int keypoint = 0;
  PointId point;
};

// One point a keypoint and one keypoint a point: those with most votes, smaller numbers first among
// equals. By keypoint, ascending.
std::vector<PointVote> MostVoted(const std::vector<PointVote>& votes);

}  // namespace stucco
