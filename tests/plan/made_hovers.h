// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "plan/camera/hover.h"
#include "plan/space/obstacles.h"
#include "site/site.h"
#include "survey/intervals.h"

namespace stucco::plan {

// One photo, for no facade.
Hover Looking(const Eigen::Vector3d& from, double yaw_deg, double pitch_deg = 0);

// One level photo each, in a square with about 225 m2 for each, at 60 m.
std::vector<Hover> RandomHovers(int count, uint64_t seed);

// Five photos each (down and four tilted), on a lattice of 14 x 10 m at 60 m.
std::vector<Hover> LatticeHovers(int count);

// Level photos of each facade from 1 m outside d_min, every 8 m along it and every 9 m down from
// the safe altitude, where they are free.
std::vector<Hover> DippingHovers(const Obstacles& obstacles);

// Of each facade, the stretches that no photo is meant for.
std::vector<Intervals> NotMeant(const Site& site, const std::vector<Hover>& hovers);

}  // namespace stucco::plan
