// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "survey/options.h"
#include "survey/stage.h"

namespace stucco {

struct IngestOptions {
  // Known intrinsics in pixels of the full photo: fx fy cx cy, or fx fy cx cy k1 k2 p1 p2 as in
  // COLMAP's OPENCV model. Empty: from the metadata of each photo.
  std::vector<double> prior_camera;
  bool prior_camera_fixed = false;  // calibration holds them
  int min_side_px = 200;            // photos with a shorter side are not used
  // No setting: a model needs two photos; to be placed in one that there is already, one is enough.
  int fewest_usable = 2;
};

void Describe(OptionTable& table, IngestOptions& options);

// Reads every photo below `context.photos` (never written to), checks its health and metadata and
// writes captures.json and contact-sheet.jpg into `context.out`. A broken photo is listed with the
// reason; only a folder that leaves fewer usable photos than `fewest_usable` is an Error
// (kBadInput).
void RunIngest(const IngestOptions& options, StageContext& context);

}  // namespace stucco
