// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "site/site.h"
#include "survey/plan_frame.h"

namespace stucco::plan {

// Reads "50.10419, 14.40238" (latitude, longitude). Throws Error (kUsage).
Geodetic ParseHome(const std::string& text);

// Where the drone takes off when nobody says where: the safe place nearest to a point south of the
// middle of the buildings. Safe: outside every no-fly zone and farther than d_min from every
// building. Throws Error where the site has no such place.
Eigen::Vector3d DefaultHome(const Site& site);

// At most `most` other safe places spread over the site, each as far as possible from those before
// it and from `site.home`, for flights that begin near their photos. Not in yards that buildings
// close in, by themselves or together.
std::vector<Eigen::Vector3d> TakeOffPlaces(const Site& site, size_t most);

// The given place on the ground. Throws Error (kUsage) where it is not safe, or not near the site.
Eigen::Vector3d CheckedHome(const Site& site, const Eigen::Vector2d& position);

}  // namespace stucco::plan
