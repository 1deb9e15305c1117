// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "survey/options.h"

namespace stucco::simulate {

// What is not perfect about a flight. Standard deviations; zero switches a thing off.
struct FlightOptions {
  int seed = 1;
  double scale = 1;  // of the camera's pixels: 0.25 gives photos a quarter as wide
  // The camera really stands and looks where the drone brought it ...
  double position_sigma_m = 0.3;
  double gimbal_sigma_deg = 0.5;
  // ... and writes down what its receiver and its gimbal tell it.
  bool rtk = false;
  double gps_bias_m = 1.5;  // one vector for a flight
  double gps_sigma_m = 0.5;
  double geoid_m = 0;  // above the ellipsoid: heights without RTK are above the sea
  double gimbal_noise_deg = 0.2;
  double distortion = 1;         // times the lens's own distortion
  double vignetting = 0.25;      // light lost in the corners
  double exposure_drift = 0.15;  // over the flight, as the sun moves
  double white_balance_drift = 0.05;
  double exposure_ev = 0;  // how much brighter than metered, in stops
  double warmth = 0;       // of the white balance: share by which red is up and blue is down
  double noise = 0.006;    // of the sensor at white, share of white
  double motion_blur_px = 0.4;
  double focus_blur_px = 0.5;
  double sharpening = 1;  // in the camera, times what drones do to their JPEGs
  std::string facades;    // ids that are photographed again, by commas; empty: the whole plan
  int most_photos = 0;    // of the plan; 0: all
  double lost_share = 0;
  double duplicate_share = 0;
  double haze_m = 4000;
  double start_hour = 10;  // local solar time of the first photo
  int day_of_year = 120;
  bool sun = true;   // false: an overcast sky
  int held_out = 0;  // photos beside the plan, for checking only
  bool write_depth = false;
  int ground_control = 0;  // points
  int jpeg_quality = 92;
};

void Describe(OptionTable& table, FlightOptions& options);

}  // namespace stucco::simulate
