// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "survey/geometry2d.h"
#include "survey/proxy.h"

namespace stucco {

// A facet in the ground plan of the upright frame, its corners in their order: those of what looks
// up counter-clockwise.
Polygon InGroundPlan(const Facet& facet, const Eigen::Matrix3d& upright_from_world);

// What the closed ones among `buildings` stand on, in the ground plan of the upright frame.
std::vector<Polygon> FloorsOf(std::span<const Building> buildings,
                              const Eigen::Matrix3d& upright_from_world);

// The same with what hangs over the ground.
std::vector<Polygon> FootprintsOf(std::span<const Building> buildings,
                                  const Eigen::Matrix3d& upright_from_world);

}  // namespace stucco
