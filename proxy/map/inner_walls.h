// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "proxy/facets/arrangement.h"
#include "proxy/map/extrude_cells.h"
#include "survey/geometry2d.h"

namespace stucco {

// Walls of a labelled ground plan (extrude_cells.h) that stand inside of a footprint, whose edges
// the first `edges` of its lines are: where the ground lies open in a corner that the map has
// built, and where a roof ends above another one. Each runs along its line from its first to its
// last piece, the higher side on its left. Creases, in which roofs meet, are none.
std::vector<Segment2d> InnerWalls(const Arrangement& arrangement, std::span<const CutLine> lines,
                                  int edges, std::span<const RoofPlane> roofs,
                                  const std::vector<int>& labels);

// Gives cells their neighbour's label where fewer walls then stand along a line for less than two
// centimetres: three lines that almost meet in a point leave such a cell in a corner of its
// neighbours. Labels of cells that are not `inside` of the footprint stay.
void DropShortWalls(const Arrangement& arrangement, std::span<const CutLine> lines,
                    std::span<const RoofPlane> roofs, const std::vector<bool>& inside,
                    std::vector<int>& labels);

}  // namespace stucco
