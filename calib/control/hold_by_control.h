// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "calib/control/ground_control.h"
#include "calib/control/measure_points.h"
#include "calib/mapping/mapper.h"
#include "calib/records/records.h"
#include "calib/scene/scene.h"
#include "survey/georef.h"
#include "survey/stage.h"

namespace stucco {

enum class PointState {
  kUsed,      // a control point that holds the model
  kMeasured,  // a check point
  kBlunder,   // a control point that contradicts the others
  kNotSeen,   // fewer than two photos with a pose place it
  kUnused,    // a good control point, but there are too few
};

struct PointOutcome {
  PointState state = PointState::kNotSeen;
  std::string why;  // for users; empty: nothing to say
  MeasuredPoint measured;
  // Where the marks and the final poses put it, minus where it was surveyed: east, north, up.
  std::optional<Eigen::Vector3d> error_m;
};

struct ControlOutcome {
  std::optional<Georef> georef;      // where control points hold the frame
  std::string why_not;               // where they do not although there are some
  std::vector<PointOutcome> points;  // by point of the ground control
  // The photos' records moved into the frame of the points, and how they err there; the scene has
  // them as priors.
  std::vector<PoseRecord> placed_records;
  std::optional<RecordErrors> records;  // measured anew in the frame of the points
  // Recorded minus true, of all flights together; nothing where the plan stood in for records.
  std::optional<Eigen::Vector3d> positions_shift_m;
};

struct ControlInput {
  const GroundControl& control;
  Eigen::Vector3d sigma_m;  // of surveyed points
  const MapperOptions& mapper;
  const std::vector<PoseRecord>& records;  // of the scene's photos
  const Georef& georef;                    // of the scene as it is
  const StageContext& context;
};

// Brings a calibrated scene to the control points and adjusts it with them: their points are
// variables held near the surveyed coordinates, their marks observations. Recorded positions take
// part with a shift that is free, so that they say what they know, the places relative to each
// other. What contradicts (five standard deviations, and five ground pixels) is named and taken
// out, then adjusted again. Check points are measured in the end and take part in nothing. Without
// three good control points off one line the scene stays as it is, and all points are checks.
ControlOutcome HoldByControl(const ControlInput& input, Scene& scene);

}  // namespace stucco
