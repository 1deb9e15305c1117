// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "plan/mission/route.h"
#include "plan/mission/wpml.h"

namespace stucco::plan {

inline constexpr size_t kLitchiWaypoints = 99;  // that a Litchi mission holds
inline constexpr size_t kLitchiActions = 15;    // that a waypoint holds

// A flight as Litchi CSV files, to be flown one after the other. Each starts and ends at return
// height, because Litchi flies straight to the first point of a file.
std::vector<std::string> LitchiCsv(const Plan& plan, const MissionRoute& route,
                                   const MissionOptions& options);

// What the user has to set in the app, because the files cannot hold it; a line each.
std::vector<std::string> LitchiSettings(const MissionRoute& route, const MissionOptions& options);

}  // namespace stucco::plan
