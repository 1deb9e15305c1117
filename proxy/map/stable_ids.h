// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "survey/proxy.h"

namespace stucco {

// The way of the line by which things are numbered, 20 degrees north of east: of the two sides of a
// gable, or the four of a hip, no two come at once.
inline const Eigen::Vector3d kNumberedAlong(0.94, 0.342, 0);

// Ids of a building of a survey that knows north that stay when it is made again, or with more
// photos: by place, not by size. Walls are parts of the planned facade that they have most of, in
// order along it, the building on the left, the lower one first: "B0012/F03.1", "B0012/F03.2". All
// else is numbered by class in the order in which a line that runs 20 degrees north of east comes
// by their middles: walls of no facade ("B0012/W00"), roofs ("B0012/R0"), floors ("B0012/G0").
// Facets are brought into that order, walls of facades first. Requires a world whose x is east and
// y north, z about up.
void AssignIdsByPlace(Building& building);

}  // namespace stucco
