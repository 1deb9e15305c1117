// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "calib/control/surveyed_places.h"
#include "calib/options/calib_options.h"
#include "calib/scene/scene.h"
#include "survey/captures.h"
#include "survey/georef.h"
#include "survey/ground_control.h"
#include "survey/stage.h"

namespace stucco {

// A surveyed point and the photos of the scene that show it.
struct MarkedPoint {
  std::string name;
  PointRole role = PointRole::kControl;
  PlaceOnEarth place;
  std::vector<PhotoMark> marks;
};

struct GroundControl {
  std::string file;  // for messages; empty: there is none
  std::vector<MarkedPoint> points;
  std::vector<std::string> problems;  // what was left out, and why
};

// What calib.ground_control names, else gcp_list.txt of the survey, else nothing. `photos` are
// those of the scene. Says in the log what is left out. Throws Error (kBadInput) when a named file
// is missing, when it is no such list, when no point is marked in a photo of the survey, or when
// its points lie far from where the photos were taken.
GroundControl ReadGroundControl(const CalibOptions& options, const Captures& captures,
                                const std::vector<const CapturedPhoto*>& photos,
                                const StageContext& context);

// A tangent frame in the middle of the points: what holds a survey without positions.
Georef FrameAtPoints(const GroundControl& control);

Eigen::Vector3d PositionIn(const Georef& georef, const PlaceOnEarth& place);

}  // namespace stucco
