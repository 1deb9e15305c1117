// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "survey/camera.h"
#include "survey/pose.h"
#include "tests/site/made_plan.h"

namespace stucco::test {

// 1000 x 750 pixels, 71 degrees wide.
Camera SiteCamera();

// Takes the photo's pose from where it stands and the angles of its gimbal.
Pose SitePose(const Eigen::Vector3d& position, double yaw_deg, double pitch_deg);

}  // namespace stucco::test
