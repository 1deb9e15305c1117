// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "capture_ingest/tags.h"
#include "survey/captures.h"

namespace stucco {

struct PositionReading {
  std::optional<GeoPosition> position;
  std::optional<double> height_above_takeoff_m;  // barometric
  std::vector<std::string> doubts;  // what was not believed: "position 0, 0 is a placeholder"
};

// Position, height and their accuracy from EXIF and the XMP of DJI, Autel, Parrot, Skydio and
// senseFly. Of two positions that agree, the one written with more digits is taken. A bad value
// costs only itself: a photo with a wrong height keeps its latitude and longitude.
PositionReading ReadPosition(const Tags& tags);

}  // namespace stucco
