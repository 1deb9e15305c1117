// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "calib/expect/expected_views.h"
#include "calib/initial_pair.h"
#include "calib/scene.h"

namespace stucco {

// Takes out pairs that contradict the plan: matches that agree with each other, but not with where
// the photos look, come from something that repeats itself (windows, paving, lawn). What one photo
// shows is looked up on the site and looked for in the other, within what positions and gimbal
// angles are good to. A photo that more pairs speak against than for is believed more than its
// record: its pairs stay. So do pairs between groups of five photos and more that no other pairs
// tie together. Uses keypoints and cameras of the scene, whose photos are those of the
// views; cameras with a guessed focal length say nothing. Returns the number of pairs taken out.
int DropContradictions(const ExpectedViews& views, const Scene& scene,
                       std::vector<VerifiedPair>& pairs);

}  // namespace stucco
