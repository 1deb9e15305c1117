// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <limits>
#include <span>
#include <vector>

#include "proxy/facets/arrangement.h"
#include "proxy/map/cell_labels.h"
#include "proxy/map/extrude_cells.h"

namespace stucco {

// The cells of a footprint, and what labels cost on them.
struct PatchInput {
  const Arrangement& arrangement;
  std::span<const CutLine> lines;     // that it was made of
  std::span<const int> face_of_cell;  // of the problem's cells
  std::span<const int> cell_of_face;  // -1: outside of the footprint
  const CellProblem& problem;         // its links are the edges between cells, in their order
  // By label; one label more is that of no roof, where the problem has it.
  std::span<const RoofPlane> roofs;
  Eigen::Vector2d axis = Eigen::Vector2d::UnitX();  // unit: what stands on a roof stands along it
  double level_of_detail = 0.1;
  // A label that costs so much on a cell cannot be there.
  double forbidden = std::numeric_limits<double>::infinity();
};

// Tidies patches of cells under one roof as people would draw them; what goes becomes the roof that
// most of its border meets.
//  - Patches smaller than four levels of detail each way go, and so do low ones (0.6 m, 6 m²):
//    boxes of machines, pieces of a parapet.
//  - So do parapets of level roofs: strips along the footprint's border that rise to it, or lie a
//    little higher (1.2 m), as points of a parapet smear over the roof behind it.
//  - So do patches of more than four corners, where these are worth more than what the patch
//    explains better than the roof around: fringes, a hand higher, where hardly anything was seen.
//  - What stands on a roof, such as the head of a staircase, is a rectangle nearly always, and a
//    graph cut leaves it with jogs where few of its points were seen: a border costs its length,
//    not its corners. So patches away from the border of the footprint that have more than four
//    corners become the best rectangle of lines along the axis, where that costs less than the
//    corners saved are worth.
void TidyPatches(const PatchInput& input, std::vector<int>& labels);

}  // namespace stucco
