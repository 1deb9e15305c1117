// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>

#include "simulate/flight/fly_request.h"
#include "simulate/flight/prepare.h"

namespace stucco::simulate {

// Takes the photos of a prepared and metered flight that are not there yet, several at a time as
// far as memory allows; the same bytes at any number of threads. `flight.made_from` says what is
// the same flight. Throws what `progress` throws.
FlySummary TakePhotos(const PreparedFlight& prepared, const Photographer& photographer,
                      const FlightOptions& options, const FlyRequest& request,
                      const std::function<void(size_t, size_t)>& progress);

}  // namespace stucco::simulate
