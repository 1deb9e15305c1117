// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>

#include "calib/scene/scene.h"
#include "survey/pose.h"

namespace stucco {

// A point of the site that a photo shows at one of its keypoints, if a match is right and the other
// photo's record too.
struct RecordSighting {
  int keypoint = 0;
  Eigen::Vector3d point = Eigen::Vector3d::Zero();  // frame of the plan
};

// How far a photo's record is off if what it shows is where the sightings say: a rigid motion in
// the frame of the plan, from where the record has the photo to where it is.
struct Correction {
  Pose moved_from_recorded;
  Eigen::Vector3d recorded = Eigen::Vector3d::Zero();  // where the record has the photo

  Eigen::Vector3d Moved() const { return moved_from_recorded * recorded; }
};

// Nothing where the sightings agree on no pose. Points and records are off by metres and degrees:
// the correction is as rough.
std::optional<Correction> ProposeCorrection(const Scene& scene, int photo,
                                            const Pose& recorded_cam_from_plan,
                                            std::span<const RecordSighting> sightings);

// Corrections that say the same, up to what records and map are off by.
struct Agreement {
  int center = 0;  // index of the one that most agree with
  int count = 0;   // of those that agree with it, itself among them
};

// The largest among corrections of photos whose records are off by the same.
Agreement LargestAgreement(std::span<const Correction> corrections);

}  // namespace stucco
