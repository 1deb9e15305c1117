// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "calib/matching/guidance.h"
#include "calib/matching/repeating_walls.h"
#include "calib/records/records.h"
#include "calib/scene/scene.h"
#include "survey/pose.h"

namespace stucco {

// Where a photo was taken, as far as a first adjustment knows.
struct KnownPose {
  Pose cam_from_plan;
  Eigen::Vector2d sigma_m = Eigen::Vector2d::Zero();  // level, per axis, and up
  double sigma_rad = 0;                               // about each axis
  bool is_recorded = false;                           // by its record, for want of anything surer
};

struct KnownPoses {
  std::vector<std::optional<KnownPose>> poses;  // by photo
  bool on_map = false;  // points of the scene show that they lie where the map's walls do
};

struct KnowInput {
  const Guidance& guidance;
  const OnRepeatingWalls& repeating;
  const std::vector<PoseRecord>& records;
};

// By photo: its pose where it is sure, else the place of others of its hover that have sure ones,
// with the angles of its record, else its record, corrected by what records of its flight err by
// and as sure as these turned out to be; nothing where it has none of these. Sure are poses that a
// hundred points hold; photos of which most shows walls that repeat themselves may hang together as
// they like: of theirs only points count that such as show something else see too. Requires a scene
// in the frame of the records, whose priors were corrected (ApplyRecords).
KnownPoses KnowPoses(const KnowInput& input, const Scene& scene);

}  // namespace stucco
