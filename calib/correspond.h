// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "calib/calibrate.h"
#include "calib/features.h"
#include "calib/seed.h"
#include "survey/captures.h"
#include "survey/stage.h"

namespace stucco {

// Features of every photo, checkpointed by content; `photos` are the usable ones.
std::vector<Features> DetectAll(const CalibOptions& options,
                                const std::vector<const CapturedPhoto*>& photos,
                                const StageContext& context);

// Verified pairs among the photos, checkpointed by the content of both.
std::vector<VerifiedPair> MatchAll(const CalibOptions& options,
                                   const std::vector<const CapturedPhoto*>& photos,
                                   const std::vector<Features>& features,
                                   const StageContext& context);

// Full-resolution pixels per pixel of the image that features are detected in.
double DetectionScale(const CalibOptions& options, const CapturedPhoto& photo);

}  // namespace stucco
