// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "calib/records/placement.h"
#include "exchange/exchanged_model.h"
#include "survey/captures.h"
#include "survey/georef.h"

namespace stucco {

// Where an imported model came to lie.
struct PlacedModel {
  Georef georef;
  PositionDifferences differences;    // to the photos' recorded positions, where the frame is "enu"
  std::vector<std::string> outliers;  // photos whose recorded positions were not used
  std::vector<std::string> notes;
};

// Brings the model into the frame of a survey, east, north, up near its cameras: from the place or
// the map that its file names, else by the recorded positions of its photos, as calib does with its
// own models. Where neither is of use it stays as it is, and a note says why. `captures` may be
// null. Throws Error (kBadInput), which names `file`, for a map that is not known.
PlacedModel PlaceModel(const std::filesystem::path& file, const Captures* captures,
                       ExchangedModel& source);

}  // namespace stucco
