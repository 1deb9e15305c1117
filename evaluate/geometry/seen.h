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

// Whether the place lies in the photo, which looks at its surface from in front at less than 80
// degrees from the normal (unit); something may stand in between.
bool IsInPhoto(const simulate::FlownPhoto& photo, const Eigen::Vector3d& place,
               const Eigen::Vector3d& normal);

// Dense matching needs so many photos of a place: two that agree, and one that confirms it.
constexpr char kPhotosToConfirm = 3;

// How many photos show each point, from in front at less than 80 degrees from the normal and with
// nothing of the scene in between; counted no further than `enough`.
std::vector<char> PhotosThatShow(std::span<const SurfacePoint> points,
                                 std::span<const simulate::FlownPhoto* const> photos,
                                 const SurfaceIndex& scene, char enough, int threads);

}  // namespace stucco::evaluate
