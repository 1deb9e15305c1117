// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "survey/proxy.h"

namespace stucco {

// Sets `party` of all facets: the share of its area that nobody sees. Of walls because walls of
// other buildings stand against it, face to face with a gap that nobody sees into (0.3 m), or
// because it lies below the ground in front of it ("G0"): on slopes walls start where the ground is
// lowest. All of the floor that closes a building, nothing of roofs and ground. `buildings` are in
// metres.
void MeasureParty(const Eigen::Vector3d& up, std::vector<Building>& buildings);

}  // namespace stucco
