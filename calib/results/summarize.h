// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "calib/results/summary_input.h"
#include "survey/calibration.h"

namespace stucco {

// Requires cameras and photos of the scene that are those of the captures, and positions' residuals
// and standard deviations of poses by photo.
Calibration Summarize(const SummaryInput& input);

}  // namespace stucco
