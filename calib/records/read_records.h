// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "calib/scene/scene.h"
#include "survey/captures.h"
#include "survey/plan.h"

namespace stucco {

// What a photo's metadata say of its pose, or its plan where they say nothing, in the frame of the
// positions (ENU).
struct PoseRecord {
  std::optional<PositionPrior> position;
  std::optional<Eigen::Quaterniond> gimbal;  // cam_from_world
  int flight = 0;                            // receivers and compasses err alike within one
  int hover = -1;  // of the flight, as planned: photos of one stand in one place; -1: none
  // Of the zero of a height by barometer, which all photos of the flight share (SteadyHeights).
  double height_zero_sigma_m = 0;
  // It shows little but walls that repeat themselves, so that its pose may be whole bays off, with
  // those of its neighbours: no witness of how positions err where there are others.
  bool may_be_bays_off = false;
};

// Records of the scene's photos, which have the given captures and whose positions are in
// ScenePhoto::prior (FrameFromPositions). Flights are those of ReadFlights, hovers the plan's.
// `plan` may be null.
std::vector<PoseRecord> ReadRecords(const std::vector<const CapturedPhoto*>& captures,
                                    const Plan* plan, const Scene& scene);

}  // namespace stucco
