// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "survey/options.h"

namespace stucco {

// Lengths are world units: metres when the survey is metric, else the free unit of calibration.
// 0 means "derive it from the data" (proxy/cloud/scale.h says how).
struct ProxyOptions {
  double level_of_detail = 0;
  double epsilon = 0;
  double normal_angle_deg = 35;
  double min_area = 0;
  int min_points = 0;
  double fill_gap = 0;
  double vertical_tolerance_deg = 8;
  double align_tolerance_deg = 6;
  int max_points = 2000000;
  bool solids = true;
  bool use_map = true;
  double solid_support = 0.65;
  int max_planes = 60;
  std::vector<double> up = {};
};

void Describe(OptionTable& table, ProxyOptions& options);

}  // namespace stucco
