// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "survey/captures.h"
#include "survey/plan.h"
#include "survey/pose.h"

namespace stucco {

// Where the photos were taken and which way they look, as far as their records and the plan say:
// cam_from_plan, good to some metres and degrees. The recorded position and gimbal angles come
// first; where one is missing, the planned view takes its place. Heights are recorded in another
// system than the plan's, and each flight may have its own: the median of their differences over
// the photos of a flight's planned views is taken off, to half a metre; a height that is then more
// than 10 m off is not believed. Nothing for a photo that has neither, and for all when the photos
// were taken somewhere else than their planned views (more than 100 m, median).
std::vector<std::optional<Pose>> ExpectedPoses(const Plan& plan,
                                               const std::vector<const CapturedPhoto*>& photos);

}  // namespace stucco
