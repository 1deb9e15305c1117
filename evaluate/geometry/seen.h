// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "evaluate/geometry/surface_index.h"
#include "simulate/flight/flight_folder.h"

namespace stucco::evaluate {

// The photos that the survey was given: neither lost nor held out.
std::vector<const simulate::FlownPhoto*> DeliveredPhotos(const simulate::Flight& flight);

// Which points at least one photo shows, from in front at less than 80 degrees from the normal and
// with nothing of the scene in between: 1 or 0 by point.
std::vector<char> SeenByAny(std::span<const SurfacePoint> points,
                            std::span<const simulate::FlownPhoto* const> photos,
                            const SurfaceIndex& scene, int threads);

}  // namespace stucco::evaluate
