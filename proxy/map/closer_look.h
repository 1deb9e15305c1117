// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "proxy/cloud/blocks.h"
#include "proxy/map/outlines.h"
#include "proxy/map/upright_survey.h"
#include "proxy/options/proxy_options.h"
#include "proxy/scene/scene.h"
#include "survey/survey_photo.h"

namespace stucco {

// Whether the scene's samples lie farther apart than its details ask for, because there are only so
// many for all of the survey while the cloud has more.
bool NeedsCloserLook(const PlanarScene& scene);

// Some buildings of a survey, by number, to look at together.
struct SetOfBuildings {
  std::vector<size_t> members;
  std::vector<size_t> beside = {};  // of other sets, which members stand wall to wall with
};

// Of a large survey some buildings at a time, so that what is seen of a building does not depend on
// how many others there are: buildings near each other, of which the samples are about as dense as
// details ask for, and no more than `max_points`. Neighbours that stand next to each other are
// members of one set, or beside it where a row of them is too long for one. Every building is a
// member of one set.
std::vector<SetOfBuildings> SetsOfBuildings(const UprightSurvey& survey,
                                            std::span<const MapBuilding> buildings, int max_points);

// What a closer look is taken at.
struct CloudOfPhotos {
  CloudBlocks blocks;
  std::span<const SurveyPhoto> photos;  // that see it
};

// The cloud thinned once more, on and around these buildings only.
UprightSurvey CloserLook(const PlanarScene& scene, const CloudOfPhotos& cloud,
                         std::span<const MapBuilding> buildings, const ProxyOptions& options,
                         int threads);

}  // namespace stucco
