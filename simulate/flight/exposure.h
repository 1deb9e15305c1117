// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "simulate/flight/options.h"
#include "simulate/render/pictures.h"

namespace stucco::simulate {

// The exposure that a camera's meter wants for a picture (a small one will do): its mean at middle
// grey, and no more than a twentieth of it clipped.
double MeteredExposure(const Radiance& picture);

// What the camera uses, by photo: the median of what it metered, options.exposure_ev stops
// brighter, from which it departs by no more than the share options.exposure_drift, slowly: a
// photo's exposure still has half of the one before. Zero: locked for the whole survey.
std::vector<double> Exposures(std::span<const double> metered, const FlightOptions& options);

// Gains by channel, `neutral` made warmer by options.warmth, with red and blue wandering smoothly
// by at most options.white_balance_drift, `time_s` since the first photo.
Eigen::Vector3d WhiteBalance(const Eigen::Vector3d& neutral, double time_s,
                             const FlightOptions& options);

// How the exposure comes about at f/2.8: 1 (white in the sun is the brightest that the sensor can
// count) is 1/1600 s at ISO 100, and no time is longer than 1/200 s.
struct Shutter {
  double time_s = 0;
  int iso = 100;
};
Shutter ShutterFor(double exposure);

}  // namespace stucco::simulate
