// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "survey/captures.h"
#include "survey/plan.h"

namespace stucco {

// Photos whose height is their barometer's.
struct SteadiedHeights {
  int num_photos = 0;
  double scatter_m = 0;  // of satellite heights about these, one standard deviation
  // By photo of the captures: how well the satellites tell the height of the barometer's zero,
  // which all photos of a flight share, one standard deviation; 0 where heights are as recorded.
  std::vector<double> zero_sigma_m;
};

// Satellite heights scatter from photo to photo by one and a half times what positions do; heights
// above the takeoff come from a barometer, which errs by decimetres within minutes, by a slow drift
// within a flight, and by whatever the takeoff's height is. So in flights (ReadFlights) of at least
// eight photos with both, heights become the barometer's, moved to where the satellites' lie in the
// middle, and tilted in time where they surely drift; their deviation becomes that of a drifting
// barometer where it was more. A photo with a position and no height gets one, too. As they are
// stay flights by RTK, those whose barometer is the rougher of the two between photos at one
// height, and those whose two heights part by more than the satellites' noise (a height above the
// ground, a reading that never changes). `plan` may be null.
SteadiedHeights SteadyHeights(const Plan* plan, Captures& captures);

}  // namespace stucco
