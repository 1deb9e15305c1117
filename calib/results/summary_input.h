// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "calib/adjust/covariance.h"
#include "calib/parts/take_apart.h"
#include "calib/records/georeference.h"
#include "calib/records/records.h"
#include "calib/scene/scene.h"
#include "survey/captures.h"
#include "survey/reconstruction.h"

namespace stucco {

// The scene as COLMAP keeps it: only registered photos, only keypoints that belong to a point.
// `photo_ids` are by photo of the scene, camera ids those of the scene's cameras.
Reconstruction ToReconstruction(const Scene& scene, const std::vector<uint32_t>& photo_ids);

struct SummaryInput {
  const Captures& captures;
  const std::vector<int>& capture_of_photo;  // scene photo -> index into captures.photos
  const Scene& scene;
  const std::map<int, std::string>& unregistered;  // photos of the scene without a pose, and why
  const PriorResiduals& priors;
  const std::vector<int>& prior_outliers;
  const RecordErrors* records = nullptr;  // where they hold the frame
  SceneSigmas sigmas = {};                // of the scene
  const SceneParts* parts = nullptr;      // where the scene was taken apart
  std::vector<int> off_together = {};     // photos, ascending: off their records as a group
  std::vector<int> ambiguous = {};        // of `unregistered`, ascending: fit more than one place
};

// Photo ids of the result by photo of the scene: the place in captures.json, counted from 1.
std::vector<uint32_t> PhotoIds(const SummaryInput& input);

}  // namespace stucco
