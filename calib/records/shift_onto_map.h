// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "survey/plan.h"

namespace stucco {

// What the map that a flight was planned on says of the site, in one frame, metres, z up.
struct SiteMap {
  std::vector<PlannedFacade> walls;
  std::vector<PlannedFootprint> footprints;
};

// How far before the wall a point lies; nothing where it lies beside, above or below it, or within
// a metre of its foot or top, where it may belong to ground or roof.
std::optional<double> BeforeWall(const PlannedFacade& wall, const Eigen::Vector3d& point);

// The level shift, metres, that brings points onto walls and, of those high above the ground, into
// footprints: of a grid of 6 m each way the one where the two shares of what is most for each add
// up to most, refined by least squares over the points on walls. Where few walls show, others a
// few metres beside lie as well under the points, but not the roofs. Zero where hardly any point
// lies on a wall then.
Eigen::Vector2d ShiftOntoMap(std::span<const Eigen::Vector3d> points, const SiteMap& map);

}  // namespace stucco
