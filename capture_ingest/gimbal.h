// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "capture_ingest/tags.h"
#include "survey/captures.h"

namespace stucco {

struct GimbalReading {
  std::optional<GimbalAngles> angles;
  std::vector<std::string> doubts;
};

// Direction of the camera from the XMP of DJI, Autel, Parrot, Skydio and senseFly, brought to one
// convention (GimbalAngles). The angles of the aircraft's body are never used.
GimbalReading ReadGimbal(const Tags& tags);

// The same rotation written with a roll below 90 degrees where that leaves the pitch near or above
// straight down: some gimbals report (yaw + 180, pitch, roll 180) close to nadir.
GimbalAngles Normalized(const GimbalAngles& angles);

}  // namespace stucco
