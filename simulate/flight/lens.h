// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "simulate/flight/options.h"
#include "survey/camera.h"
#include "survey/plan.h"

namespace stucco::simulate {

// The lens as it is: the planned camera at options.scale with what tells one body from its data
// sheet, drawn from the seed: a focal length up to 1.5 % off, the principal point off the centre,
// distortion of a few percent in the corners (OPENCV). Every pixel has exactly one ray. Throws
// Error (kBadInput) for a plan without a camera.
Camera MakeLens(const PlannedCamera& planned, const FlightOptions& options);

// The whole millimetres that a camera writes as its focal length on 35 mm film, by the diagonal.
int FocalOn35mm_mm(const PlannedCamera& planned);

}  // namespace stucco::simulate
