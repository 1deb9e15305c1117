// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <numbers>
#include <vector>

#include "calib/records/read_records.h"
#include "calib/scene/scene.h"

namespace stucco {

// How far a scene is turned about up against its photos' recorded positions.
struct SceneHeading {
  double turn_rad = 0;                  // that makes the scene fit, counter-clockwise from above
  double sigma_rad = std::numbers::pi;  // of the turn
};

// By least squares with Cauchy weights, each flight about its own middle: receivers err by a shift
// that may differ from flight to flight. Flights too small for a shift of their own count as one.
// Photos that are no witnesses of positions say nothing.
SceneHeading HeadingByPositions(const std::vector<PoseRecord>& records, const Scene& scene);

}  // namespace stucco
