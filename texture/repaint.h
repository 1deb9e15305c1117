// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "survey/epoch.h"
#include "survey/stage.h"
#include "survey/survey_photo.h"
#include "texture/options/texture_options.h"

namespace stucco {

// Photos of another day, placed in the world of a finished survey.
struct RepaintRequest {
  std::string epoch;                // what comes before their paths, and a colon, in textures.json
  std::vector<SurveyPhoto> photos;  // paths below `StageContext::photos`
  ReplaceMode replace = ReplaceMode::kAuto;
};

// Paints the facets of a finished texture stage from other photos, on the grids that the stage
// left, decides facet by facet what becomes of its picture (Decide), and writes a whole epoch below
// `context.out`: textures.json, textures/, labels/, orthophotos/, model.glb and model.obj. Pictures
// that are kept have the bytes they had. Of the survey nothing is written, and its photos need not
// be there. In the order of texture/textures.json. Throws Error (kBadInput) where the survey's
// textures are missing, damaged or not of its facets, (kStageFailed) when the photos show no facet.
std::vector<EpochFacet> RepaintSurvey(const TextureOptions& options, const RepaintRequest& request,
                                      StageContext& context);

}  // namespace stucco
