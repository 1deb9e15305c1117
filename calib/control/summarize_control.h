// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "calib/control/hold_by_control.h"
#include "survey/calibration.h"

namespace stucco {

// Limits of errors in pixels on the ground, as users of photogrammetry know them: twice that
// horizontally and three times vertically is what a sound survey reaches. Twice as much is red.
// Nothing is judged more finely than the points were surveyed.
inline constexpr double kGreenHorizontal_pixels = 2;
inline constexpr double kGreenVertical_pixels = 3;
inline constexpr double kRedOverGreen = 2;

// Fills ground_control, control_rms, check_rms and the shift of the records, and adds findings.
// `sigma_m` is that of surveyed points.
void SummarizeControl(const GroundControl& control, const ControlOutcome& outcome,
                      const Eigen::Vector3d& sigma_m, Calibration& calibration);

}  // namespace stucco
