// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "calib/scene/scene.h"

namespace stucco {

// How surely matches alone hold a flight against all others: one standard deviation of a common
// motion of its photos, a kilometre and ten radians where nothing ties it.
struct FlightTie {
  double position_m = 1e3;  // of the middle of the photos, root of the sum over the axes
  double yaw_rad = 10;      // about up
};

// By flight, of the points that photos of this and of another flight see, and of control points,
// which hold each flight by itself. Matches of one photo err together (a narrow strip of wall is
// told from its neighbour by less than a pixel, however many keypoints it has), so that those of
// one photo count as four, and as none where there are fewer than fifteen; and a flight is held no
// better than the photos on either side hold it.
// A flight that has no other beside it is held by definition: zero.
std::vector<FlightTie> TiesOfFlights(const std::vector<int>& flight_of_photo, const Scene& scene);

}  // namespace stucco
