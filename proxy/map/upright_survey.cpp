// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/map/upright_survey.h"

#include <utility>

#include "proxy/map/outlines.h"

namespace stucco {

UprightSurvey UprightSurveyOf(const PlanarScene& scene) {
  return UprightSurveyOf(scene.samples, scene.tolerances, scene.up);
}

UprightSurvey UprightSurveyOf(Samples samples, const Tolerances& tolerances,
                              const Eigen::Vector3d& up) {
  constexpr double kBin_m = 2;  // a building has some dozens
  const Eigen::Matrix3d upright_from_world = UprightFromWorld(up);
  for (auto& p : samples.positions) p = upright_from_world * p;
  for (auto& n : samples.normals) n = upright_from_world * n;
  for (auto& eye : samples.camera_centers) eye = upright_from_world * eye;
  PlanBins bins(samples.positions, kBin_m);
  return {std::move(samples), std::move(bins), tolerances};
}

}  // namespace stucco
