// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "survey/camera.h"
#include "survey/plan.h"
#include "survey/pose.h"

namespace stucco::test {

// A plan with one house of 20 by 10 m and 12 m height, its long wall along y = 0 facing south
// (facade 0), and a second one of the same size 40 m further south. z = 0 is the ground.
Plan TwoHouses();

// 1000 x 750 pixels, 71 degrees wide.
Camera SiteCamera();

// Takes the photo's pose from where it stands and the angles of its gimbal.
Pose SitePose(const Eigen::Vector3d& position, double yaw_deg, double pitch_deg);

}  // namespace stucco::test
