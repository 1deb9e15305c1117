// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "plan/mission/wpml.h"

namespace stucco::plan {

// The files of one flight, in every format.
struct FlightFiles {
  size_t flight = 0;           // of the plan, from 0
  double return_height_m = 0;  // above its take-off point, which the files ask for
  std::vector<std::string> names;
};

struct MissionFiles {
  std::vector<std::string> names;    // in the folder, sorted by kind
  std::vector<FlightFiles> flights;  // that leave the ground
  std::vector<std::string> notes;    // what the user has to know or to set, a line each
};

// Writes mission.kmz (DJI WPML; checked by LintKmz), mission.csv (Litchi), mission.plan
// (QGroundControl), mission.kml and plan.geojson into a folder that exists; mission_1.kmz and so on
// where there are several flights, mission_1_2.csv where Litchi needs several files for one. Throws
// Error when a file cannot be written, or when the linter finds fault with ours.
MissionFiles WriteMissionFiles(const Plan& plan, const MissionOptions& options,
                               const std::filesystem::path& folder);

}  // namespace stucco::plan
