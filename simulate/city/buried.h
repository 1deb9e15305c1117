// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "simulate/city/ground.h"
#include "simulate/city/town.h"

namespace stucco::simulate {

// How much of an upright face over the segment from a to b, from `foot_m` upwards, lies below the
// ground as it is drawn: cells of a slope are pairs of triangles.
double BuriedArea(const Town& town, const GroundGrid& grid, const Eigen::Vector2d& a,
                  const Eigen::Vector2d& b, double foot_m);

}  // namespace stucco::simulate
