// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "proxy/cloud/samples.h"
#include "proxy/cloud/scale.h"
#include "proxy/map/plan_bins.h"
#include "proxy/scene/scene.h"

namespace stucco {

// What the cloud shows in the frame whose z is up: what a map is held against.
struct UprightSurvey {
  Samples samples;
  PlanBins bins;  // of the samples
  Tolerances tolerances;
};

UprightSurvey UprightSurveyOf(const PlanarScene& scene);
// Turns samples of the scene's cloud.
UprightSurvey UprightSurveyOf(Samples samples, const Tolerances& tolerances,
                              const Eigen::Vector3d& up);

}  // namespace stucco
