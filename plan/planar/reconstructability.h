// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>

namespace stucco::plan {

// How well a point of a surface can be reconstructed from the photos that see it. Paper: Smith et
// al., "Aerial Path Planning for Urban Scene Reconstruction" (2018): h sums w1 w2 w3 cos(t) over
// pairs of places, t the flatter of the two rays' angles with the normal; w4 is ours.

// w1: enough parallax between two rays at this angle. Half at pi/16.
double ParallaxWeight(double angle_rad);
// w2: 1 at the surface, 0 from d_max on.
inline double ResolutionWeight(double distance_m, double d_max_m) {
  return 1 - std::min(distance_m / d_max_m, 1.0);
}
// w3: still alike enough to be matched. Half at pi/4.
double MatchWeight(double angle_rad);

// w4: photos at these distances show a patch so alike in scale. Smith et al. have none, as their
// photos are all about as far away; ours are not (dips, link photos).
inline double ScaleWeight(double distance_m, double other_m) {
  return std::min(distance_m, other_m) / std::max(distance_m, other_m);
}

// One good pair at this distance: rays 17.3 degrees apart, the normal between them. Thresholds are
// multiples of it (Zhou et al., "Offsite Aerial Path Planning for Efficient Urban Scene
// Reconstruction", 2020).
double GoodPair(double distance_m, double d_max_m);

}  // namespace stucco::plan
