// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "proxy/cloud/samples.h"
#include "proxy/cloud/scale.h"
#include "proxy/planes/plane.h"

namespace stucco {

struct Clusters {
  // Each building's planes with only the points that are its own; the one with most area first.
  std::vector<std::vector<Plane>> buildings;
  int dropped = 0;  // clusters too small or too low for a building: cars, benches, hedges
};

// Splits planes into buildings: what stands together in the ground plan, seen from above on a grid
// of `fill_gap`. Used where there is no map. With ground a lone roof counts as high as it lies
// above it.
Clusters SplitIntoBuildings(const Samples& samples, const Tolerances& tolerances,
                            const Eigen::Vector3d& up, std::span<const Plane> ground,
                            const std::vector<Plane>& planes);

}  // namespace stucco
