// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "site/map_wall.h"
#include "survey/intervals.h"

namespace stucco::internal {

// A part of a wall that nothing hides.
struct SeenPiece {
  int wall = 0;
  Interval along_m;  // from a
};

// True when p lies strictly on the wall's outer side. Exact.
bool IsInFrontOf(const MapWall& wall, const Eigen::Vector2d& p);

// The visible pieces of walls that all face p. Walls may touch but not cross.
std::vector<SeenPiece> Sweep(std::span<const MapWall> walls, const Eigen::Vector2d& p);

}  // namespace stucco::internal
