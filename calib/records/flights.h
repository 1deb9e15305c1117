// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "survey/captures.h"
#include "survey/plan.h"

namespace stucco {

// When a photo was taken, and in which flight.
struct TakenIn {
  int flight = 0;                // from 0, in time
  int order = 0;                 // among all photos, in time
  std::optional<double> time_s;  // by the camera's clock, to whole seconds
};

// By photo. The flight is that of the planned view; photos that have none belong to that of the
// photo before them in time, and without any flight pauses of five minutes and changes of the
// camera tell flights apart. `plan` may be null.
std::vector<TakenIn> ReadFlights(const std::vector<const CapturedPhoto*>& captures,
                                 const Plan* plan);

}  // namespace stucco
