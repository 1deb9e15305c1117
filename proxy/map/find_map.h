// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "proxy/map/closer_look.h"
#include "proxy/map/outlines.h"
#include "proxy/map/registration.h"
#include "proxy/map/upright_survey.h"
#include "proxy/options/proxy_options.h"
#include "proxy/scene/scene.h"

namespace stucco {

// Where the survey shows a map.
struct PlaceOfMap {
  MapRegistration registration;
  double plan_to_survey_m = 0;
};

// What a map is found with.
struct MapSearch {
  const PlanarScene& scene;
  const std::optional<CloudOfPhotos>& cloud;  // to look closer; nothing: the survey is fine enough
  const ProxyOptions& options;
  int threads;
};

// RegisterMap, and the height. Of a survey whose samples are too coarse for walls the map is found
// at some places of it, which are looked at closely, as far around as a map may lie off.
PlaceOfMap FindMap(const UprightSurvey& survey, const OutlineMap& map, const MapSearch& with);

OutlineMap Moved(OutlineMap map, const Eigen::Isometry2d& motion);

}  // namespace stucco
