// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "survey/georef.h"
#include "survey/proxy.h"
#include "survey/stage.h"
#include "survey/survey_photo.h"
#include "texture/options/texture_options.h"
#include "texture/views/visibility.h"

namespace stucco {

// Everything that painting reads from the survey folder.
struct TextureInput {
  Proxy proxy;
  Georef georef;
  std::vector<SurveyPhoto> photos;  // posed and on disk, by name
  SightedPoints cloud;              // thinned; empty without one
  std::string geometry_hash;        // of the proxy and the cloud
};

// All but the photos: proxy/facets.json and, where they are, calib/georef.json and dense/cloud.ply
// (option `occluders`). Throws Error (kBadInput).
TextureInput ReadSurfaces(const StageContext& context, const TextureOptions& options);

// Reads proxy/facets.json, calib/sparse/0 and, where they are, calib/georef.json,
// ingest/captures.json, dense/cloud.ply (option `occluders`) and plan/plan.json (`guided`). Throws
// Error (kBadInput) when a posed photo's file is gone: painting without it would look finished and
// never be done again.
TextureInput ReadTextureInput(const StageContext& context, const TextureOptions& options);

}  // namespace stucco
