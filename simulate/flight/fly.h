// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>

#include "simulate/flight/fly_request.h"
#include "simulate/flight/options.h"

namespace stucco::simulate {

// Flies a plan through a scene: photos with the metadata that a drone writes into SURVEY/photos,
// the truth beside them. `progress` hears (0, total) when all input is known to be
// sound and nothing is written yet, then (done, total) after each photo, one call at a time; what
// it throws ends the flight. What an interrupted flight has finished is kept: the same call goes
// on; a call with other options or another scene replaces the photos of the flight before, and
// nobody else's. Throws Error (kBadInput): the plan is for another place, cameras stand inside
// buildings, the survey has another plan, photos of a real flight ...
FlySummary Fly(const FlyRequest& request, const FlightOptions& options,
               const std::function<void(size_t, size_t)>& progress);

}  // namespace stucco::simulate
