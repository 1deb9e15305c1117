// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "survey/options.h"
#include "survey/stage.h"

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
  double min_angle_deg = 1.5;
  bool fast_adjustment = false;
};

void Describe(OptionTable& table, CalibOptions& options);

// Features -> matches -> structure from motion -> bundle adjustment -> georeferencing.
// Reads ingest/captures.json and the photos it lists as usable. Writes below context.out:
//   sparse/0/{cameras,images,points3D}.{bin,txt}   COLMAP's format, world frame as georef.json says
//   georef.json, calibration.json
// Throws Error (kStageFailed) when no two photos can be oriented, saying what was found instead.
void RunCalib(const CalibOptions& options, StageContext& context);

}  // namespace stucco
