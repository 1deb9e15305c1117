// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "calib/matching/guidance.h"
#include "survey/captures.h"

namespace stucco {

// The usable photos of a survey, their cameras, and what the plan says of them.
struct PhotoSet {
  const Captures& captures;
  const std::vector<const CapturedPhoto*>& photos;
  const Guidance& guidance;
};

// One standard deviation of the focal length that the metadata say, relative to it; 0 where it is
// given as the truth.
double FocalSigmaRatio(const CapturedCamera& camera);

}  // namespace stucco
