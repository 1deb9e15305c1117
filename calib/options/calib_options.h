// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "survey/options.h"

namespace stucco {

struct CalibOptions {
  int max_image_px = 3200;
  int max_features = 8192;
  double match_ratio = 0.8;
  int exhaustive_below = 150;
  int neighbours = 40;
  std::string camera_model = "OPENCV";
  bool refine_principal_point = true;
  bool use_positions = true;
  std::string georef = "positions";
  double min_angle_deg = 1.5;
  bool fast_adjustment = false;
  std::string ground_control;
  double control_sigma_horizontal_m = 0.02;
  double control_sigma_vertical_m = 0.03;
};

void Describe(OptionTable& table, CalibOptions& options);

}  // namespace stucco
