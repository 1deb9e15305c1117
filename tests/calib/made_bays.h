// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "calib/features/features.h"
#include "survey/pose.h"

namespace stucco::test {

// The south wall of the first of TwoHouses, from x = 1 to 19 m, with bays of 3 m. What a photo of
// SiteCamera finds of it: 30 keypoints of each bay, `alike` to the entry in all of them or
// different in each.
Features SeeBays(const Pose& cam_from_plan, bool alike);

}  // namespace stucco::test
