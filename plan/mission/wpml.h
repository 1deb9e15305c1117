// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "plan/mission/route.h"

namespace stucco::plan {

// Numbers by which DJI's files name a drone and its camera (droneEnumValue and so on).
struct DroneEnums {
  int drone = 0;  // 0: the drone has none, no WPML can be written for it
  int sub = 0;
  int payload = 0;  // 0: not named, as for drones of DJI Fly
};
inline constexpr int kDjiFlyDrone = 68;  // all that fly with DJI Fly share it

struct MissionOptions {
  DroneEnums dji;
  PlannedPace pace;
  // Stands in the files instead of the clock, so that they depend on the plan alone.
  int64_t created_ms = 1767225600000;  // 2026-01-01
};

// The two documents of a DJI mission: what Pilot 2 shows and edits, and what the drone executes.
std::string WpmlTemplate(const Plan& plan, const MissionRoute& route,
                         const MissionOptions& options);
std::string WpmlWaylines(const MissionRoute& route, const MissionOptions& options);

// Both in a KMZ; the same plan gives the same bytes. Throws Error when it cannot be written.
void WriteWpmlKmz(const Plan& plan, const MissionRoute& route, const MissionOptions& options,
                  const std::filesystem::path& path);

}  // namespace stucco::plan
