// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "evaluate/figures/evaluation.h"
#include "simulate/flight/flight_folder.h"
#include "survey/georef.h"
#include "survey/pose.h"
#include "survey/reconstruction.h"

namespace stucco::evaluate {

struct PoseComparison {
  PoseFigures figures;
  std::optional<Similarity> truth_from_world;  // none: too few photos to tell
  std::vector<std::string> notes;
};

// `survey` and `scene` say where both frames lie; unless both are "enu", georeferenced errors are
// not measured. Photos are matched by path, else by file name where that is unique.
PoseComparison ComparePoses(const Reconstruction& result, const Georef& survey,
                            const simulate::Flight& truth, const Georef& scene);

// Of a point between two tangent frames.
Eigen::Vector3d BetweenFrames(const Georef& from, const Georef& to, const Eigen::Vector3d& point);

}  // namespace stucco::evaluate
