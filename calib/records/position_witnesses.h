// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "calib/records/read_records.h"
#include "calib/scene/scene.h"

namespace stucco {

// What is measured of a flight by itself has at least as many photos.
inline constexpr int kEnoughForOneFlight = 8;
// Receivers are no better than this among themselves.
inline constexpr double kLeastPosition_m = 0.01;

// By photo, whether it tells how recorded positions err: those that have a pose and a position, and
// of each flight only those that cannot be whole bays off, where these are enough. A front of such
// photos that hang together is most of some flights, and moved the flight with it.
std::vector<bool> PositionWitnesses(const std::vector<PoseRecord>& records, const Scene& scene);

}  // namespace stucco
