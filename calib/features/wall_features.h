// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "calib/features/features.h"
#include "calib/features/match.h"
#include "survey/camera.h"
#include "survey/image.h"
#include "survey/plan.h"
#include "survey/pose.h"

namespace stucco {

// The part of a planned wall that a photo should show, and from where.
struct WallView {
  PlannedFacade wall;  // a, b and z are used
  Interval along_m;    // from a
  Interval z_m;
  Pose cam_from_plan;
};

// Where a keypoint lies on the wall if the photo's expected pose is right.
struct OnWall {
  float along_m = 0;
  float z_m = 0;
  float scale_m = 0;  // standard deviation of the blob
};

// Features of the wall rectified: the photo is drawn on the wall's plane first, so that oblique
// photos and frontal ones give the same descriptors (as view-synthesis matchers do for unknown
// planes: Morel and Yu, "ASIFT", 2009). `image` is the photo scaled for detection; keypoints are in
// pixels of `camera`, the full photo.
Features DetectOnWall(const Image& image, const Camera& camera, const WallView& view,
                      int max_features);

// Where a keypoint lies on the plane of the wall as the view has it; nothing where the camera looks
// away from it.
std::optional<OnWall> PlaceOnWall(const Keypoint& keypoint, const Camera& camera,
                                  const WallView& view);

// Of keypoints that DetectOnWall found with the same view.
std::vector<OnWall> PlacesOnWall(const Features& features, const Camera& camera,
                                 const WallView& view);

// Keypoints of one photo on one wall, as many of both.
struct WallKeypoints {
  std::vector<int16_t> descriptors;  // as UnitDescriptors gives them
  std::vector<OnWall> places;
};

// Keypoints in the order of their places along the wall.
struct AlongOrder {
  std::vector<int> index;
  std::vector<float> along_m;
  std::vector<int16_t> descriptors;
};

AlongOrder SortAlong(const WallKeypoints& keypoints);

// Mutual nearest neighbours among keypoints of like size within `reach_m` of each other on the
// wall, which pass the ratio test among these.
std::vector<Match> MatchWithin(const WallKeypoints& first, const WallKeypoints& second,
                               double reach_m, double ratio);

// Mutual nearest neighbours among keypoints of like size within `reach_m` of each other on the
// wall, which pass the ratio test among those within 2.5 times as much: what repeats along the wall
// farther off does not confuse. Where nearest neighbours within 2.5 times the reach agree on one
// shift, as records that are off give it to a whole wall, and on no other nearly as well, matches
// are those within a metre of it, if these are more.
std::vector<Match> MatchOnWall(const WallKeypoints& first, const WallKeypoints& second,
                               double reach_m, double ratio);

}  // namespace stucco
