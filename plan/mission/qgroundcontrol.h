// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "plan/mission/route.h"
#include "plan/mission/wpml.h"

namespace stucco::plan {

// A flight as QGroundControl's .plan for PX4: take-off, stops with gimbal and photo, return;
// no-fly polygons as a fence.
std::string QGroundControlPlan(const Plan& plan, const MissionRoute& route,
                               const MissionOptions& options);

}  // namespace stucco::plan
