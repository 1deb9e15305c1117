// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <vector>

#include "calib/features/features.h"
#include "calib/matching/shown_walls.h"
#include "survey/pose.h"

namespace stucco::test {

// The south wall of the first of TwoHouses, from x = 1 to 19 m, with bays of 3 m. What a photo of
// SiteCamera finds of it: 30 keypoints of each bay, `alike` to the entry in all of them or
// different in each.
Features SeeBays(const Pose& cam_from_plan, bool alike);

// The keypoint `i` of a bay, wherever that is in the photo: what it looks like is another for each
// `look`. Nothing where the photo does not show it.
void SeeKeypoint(const Pose& cam_from_plan, int bay, int i, int look, Features& features);

// The pose `off` from there, with the same angles.
Pose Moved(const Pose& pose, const Eigen::Vector3d& off);

// Photos of that wall, which is known to repeat itself.
class BaysTest : public testing::Test {
 protected:
  BaysTest();
  void Take(const Pose& cam_from_plan, bool alike);
  void Take(const Features& seen);
  // Valid until the next is taken.
  PhotoSet Photos();

  CalibOptions options_;
  Captures captures_;
  Guidance guidance_;
  DetectedFeatures features_;
  OnRepeatingWalls repeating_;
  StageContext context_;

 private:
  std::vector<const CapturedPhoto*> photos_;
};

}  // namespace stucco::test
