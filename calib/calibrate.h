// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "calib/options/calib_options.h"
#include "survey/stage.h"

namespace stucco {

// Features -> matches -> structure from motion -> bundle adjustment -> georeferencing.
// Reads ingest/captures.json and the photos it lists as usable. Writes below context.out:
//   sparse/0/{cameras,images,points3D}.{bin,txt}   COLMAP's format, world frame as georef.json says
//   sparse/1 ...                                   parts that do not hang together with it
//   georef.json, calibration.json, photos.csv
// Throws Error (kStageFailed) when no two photos can be oriented, saying what was found instead.
void RunCalib(const CalibOptions& options, StageContext& context);

}  // namespace stucco
