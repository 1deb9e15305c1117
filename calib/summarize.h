// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "calib/georeference.h"
#include "calib/mapper.h"
#include "calib/scene.h"
#include "survey/calibration.h"
#include "survey/captures.h"
#include "survey/reconstruction.h"

namespace stucco {

// The scene as COLMAP keeps it: only posed photos, only keypoints that belong to a point. Photo ids
// are `photo_ids`, camera ids those of the scene's cameras.
Reconstruction ToReconstruction(const Scene& scene, const std::vector<uint32_t>& photo_ids);

struct SummaryInput {
  const Captures& captures;
  const std::vector<int>& capture_of_photo;  // scene photo -> index into captures.photos
  const Scene& scene;
  const MapReport& map;
  const PriorResiduals& priors;
  const std::vector<int>& prior_outliers;
};

Calibration Summarize(const SummaryInput& input);

}  // namespace stucco
