// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/options/calib_options.h"

namespace stucco {

void Describe(OptionTable& table, CalibOptions& options) {
  table.Add(
      "max_image_px", options.max_image_px, 400, 20000,
      "Photos are reduced to this many pixels on the longer side before features are detected.");
  table.Add("max_features", options.max_features, 200, 100000, "Features kept per photo.");
  table.Add("match_ratio", options.match_ratio, 0.3, 0.99,
            "A match's descriptor angle must be below this share of the second best one's.");
  table.Add("exhaustive_below", options.exhaustive_below, 2, 100000,
            "Up to this many photos every pair is matched, unless a plan says which overlap.");
  table.Add(
      "neighbours", options.neighbours, 2, 1000,
      "Photos matched with each: those that should overlap most by the plan; without one, the "
      "nearest by position and as many by appearance.");
  table.Add("camera_model", options.camera_model, {"PINHOLE", "OPENCV", "FULL_OPENCV"},
            "COLMAP's name of the lens model that is calibrated.");
  table.Add("refine_principal_point", options.refine_principal_point,
            "Calibrate the principal point and tangential distortion too.");
  table.Add("use_positions", options.use_positions,
            "Use the positions in the photos (GPS, RTK) for scale, direction and adjustment.");
  table.Add("georef", options.georef, {"positions", "map"},
            "What says where the model lies: the photos' positions, or the walls of the map that "
            "the flight was planned on, onto which it is then moved (level; ground control counts "
            "more than both). How far apart the two are is in calibration.json either way.");
  table.Add("min_angle_deg", options.min_angle_deg, 0.1, 30,
            "Points seen under a smaller angle are dropped, degrees.");
  table.Add(
      "fast_adjustment", options.fast_adjustment,
      "Adjust on all threads: faster, but results differ in the last digits from run to run.");
  table
      .Add("ground_control", options.ground_control, {},
           "File of ground control and check points, from the survey's folder on; empty: "
           "gcp_list.txt, where there is one.")
      .is_input_file = true;
  table.Add("control_sigma_horizontal_m", options.control_sigma_horizontal_m, 0.001, 10,
            "Standard deviation of surveyed points east and north, metres.");
  table.Add("control_sigma_vertical_m", options.control_sigma_vertical_m, 0.001, 10,
            "Standard deviation of surveyed points in height, metres.");
}

}  // namespace stucco
