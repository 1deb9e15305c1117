// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace stucco::plan {

// What flying costs.
struct Effort {
  double battery_percent = 0;  // of one battery of the drone; 250 is two and a half
  double time_min = 0;
};

// Of a flight of this length with this many hovering positions. Linear in both, with the factors
// that fit best (least squares of relative errors) to the fourteen flights of a Mavic 3E that Xiong
// et al., "Aerial Path Planning for Urban Geometry and Texture Co-Capture" (2025), publish: mean
// relative error 8.8 % in energy, 8.4 % in time. `battery_scale`: batteries of that drone that one
// of this drone is worth; it changes the energy, not the time.
Effort EstimateEffort(double length_m, int hovers, double battery_scale);

}  // namespace stucco::plan
