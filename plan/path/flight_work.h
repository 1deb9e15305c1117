// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "plan/camera/hover.h"
#include "plan/path/energy.h"
#include "plan/space/safe_space.h"

namespace stucco::plan {

// What the parts of a flight do, as missions command them: the drone stops at every corner of a
// route, turns to the next photo while it flies there, and tilts its camera once it is there.

// All photos of a hover, from the heading and tilt of the first to those of the last.
FlightWork StopWork(const Hover& hover, const PlannedPace& pace);

// From one hover to the next along a route, until the camera points as the first photo wants it.
FlightWork HopWork(const Hover& from, const Route& route, const Hover& to, const PlannedPace& pace);

// From home to the first stop or back along a route.
FlightWork TransferWork(const Route& route, const PlannedPace& pace);
// The tilt from level, as it is after take-off, to the first photo.
FlightWork FirstTiltWork(const Hover& first, const PlannedPace& pace);

}  // namespace stucco::plan
