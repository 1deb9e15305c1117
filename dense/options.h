// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "survey/options.h"

namespace stucco {

struct DenseOptions {
  int max_image_px = 1600;
  int max_sources = 6;
  int min_consistent = 2;
  double max_cost = 0.5;
  double max_reprojection_px = 1.5;
  double max_depth_difference = 0.01;
  int iterations = 1;
  double outlier_sigmas = 3;
  bool write_depth_maps = false;
};

void Describe(OptionTable& table, DenseOptions& options);

}  // namespace stucco
