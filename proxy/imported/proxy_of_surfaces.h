// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "survey/georef.h"
#include "survey/plan.h"
#include "survey/proxy.h"
#include "survey/surface_model.h"
#include "survey/survey_photo.h"

namespace stucco {

// What a model of another program is held against.
struct SurfaceSurvey {
  std::filesystem::path cloud;          // dense/cloud.ply; empty: not made yet
  std::vector<Eigen::Vector3d> points;  // of the calibration
  std::span<const SurveyPhoto> photos;
  Georef georef;
  std::optional<Plan> plan = std::nullopt;
};

struct SurfaceProxy {
  Proxy proxy;
  std::vector<std::string> notes;
};

// A model of another program as the planar model of a survey: polygons in one plane are one facet
// (flat_pieces.h), sorted to buildings and classes (sort_pieces.h), with the points that lie on
// them (measure_support.h) and the facades of the plan that they are parts of. `moves`: the model
// may be moved onto the points first (fit_to_points.h). The model is in the world of the survey.
// Throws Error (kBadInput), which names `file`: not made of planes, or not where the photos look.
SurfaceProxy ProxyOfSurfaces(SurfaceModel model, const SurfaceSurvey& survey, bool moves,
                             const std::string& file);

}  // namespace stucco
