// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "proxy/cloud/samples.h"
#include "survey/georef.h"
#include "survey/plan.h"
#include "survey/survey_photo.h"

namespace stucco {

// What the planar model is made from.
struct ProxyInput {
  PointStream cloud;
  std::vector<SurveyPhoto> photos;  // the cloud's `views` are their ids
  Georef georef;
  std::optional<Plan> plan = std::nullopt;  // that the survey was flown by
};

}  // namespace stucco
