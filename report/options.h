// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "survey/options.h"

namespace stucco {

// Limits of the verdicts; a facade has the worst colour of its measures. Shares are in [0, 1].
struct ReportOptions {
  double coverage_amber_below = 0.9;  // share of the facade's area painted from photos
  double coverage_red_below = 0.6;
  double gsd_amber_above = 1.5;  // times the survey's median size of a photo pixel on a facade
  double gsd_red_above = 3;
  double inpainted_amber_above = 0.05;  // share of the area filled in without a photo
  double inpainted_red_above = 0.25;
  double inferred_amber_above = 0.4;  // share of the area without measured points
  double inferred_red_above = 0.8;
  double misregistration_amber_above = 2;  // texels between overlapping photos
  double misregistration_red_above = 5;
  double least_area_m2 = 2;   // of what of a facet can be seen; smaller ones have no verdict
  int picture_px = 900;       // longer side of the facade pictures in the page
  bool record_times = false;  // times and memory in the outputs, which then differ between runs
};

void Describe(OptionTable& table, ReportOptions& options);

}  // namespace stucco
