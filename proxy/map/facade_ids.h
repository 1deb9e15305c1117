// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "survey/geometry2d.h"
#include "survey/georef.h"
#include "survey/plan.h"
#include "survey/proxy.h"

namespace stucco {

// A wall seen from above, the building on its left; at the middle of its height where it leans.
Segment2d LineOf(const Facet& wall);

// How far the facades have to be moved, east and north, to lie on the walls: the shift on which
// most metres of wall find a facade that is parallel, faces the same way and runs beside them. GPS
// puts a whole survey some metres off. Nothing where fewer than half of the walls, or of the
// facades where those are fewer, find one; near ones count more.
std::optional<Eigen::Vector2d> FindShift(const std::vector<Segment2d>& walls,
                                         const std::vector<Segment2d>& facades);

// For every wall the facades that it is a part of or spans once the facades are moved, the one it
// has most of first.
std::vector<std::vector<int>> MatchWalls(const std::vector<Segment2d>& walls,
                                         const std::vector<Segment2d>& facades,
                                         const Eigen::Vector2d& shift);

// What naming came to.
struct FacadeNaming {
  size_t walls = 0;    // of the proxy
  size_t named = 0;    // of them
  size_t facades = 0;  // of the plan, with a wall
  std::optional<Eigen::Vector2d> shift_m;
};

// Names the plan's facades that walls of the proxy are parts of (`planned_facades`); the walls of a
// survey that is not where the plan is get none. Requires facets without any and an "enu" georef.
FacadeNaming NameFacades(const Plan& plan, const Georef& georef, Proxy& proxy);

}  // namespace stucco
