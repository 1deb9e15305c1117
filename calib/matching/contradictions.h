// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "calib/expect/expected_views.h"
#include "calib/scene/scene.h"
#include "calib/two_view/initial_pair.h"

namespace stucco {

// Takes out pairs that contradict the plan: matches that agree with each other, but not with where
// the photos look, come from something that repeats itself (windows, paving, lawn). What one photo
// shows is looked up on the site and looked for in the other, within what positions and gimbal
// angles are good to. Where pairs of a photo, or of a part of the survey, contradict its record,
// they may be right and the record wrong: then they all say the same of it. At least three of them
// and the majority must agree on one turn and shift of the record, seen from photos whose records
// fit; it is corrected and the pairs are judged anew. What contradicts then goes, unless neither
// photo's record is believed. A shift by one window that most pairs agree on is not seen. Uses
// keypoints and cameras of the scene, whose photos are those of the views; cameras with a guessed
// focal length say nothing. Returns the number of pairs taken out.
int DropContradictions(const ExpectedViews& views, const Scene& scene,
                       std::vector<VerifiedPair>& pairs);

}  // namespace stucco
