// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "proxy/facets/arrangement.h"
#include "proxy/map/extrude_cells.h"
#include "proxy/map/outline_fit.h"
#include "proxy/map/roof_planes.h"

namespace stucco {

// A footprint cut to cells, each with its roof.
struct RoofCells {
  Arrangement arrangement;
  std::vector<CutLine> lines;    // what cut it
  std::vector<RoofPlane> roofs;  // the planes, in their order; then a level one in their middle
  std::vector<int> labels;       // of each cell: its roof; -1: outside of the building
};

// Cuts the footprint along its own edges, along the lines in which its roof planes meet, and along
// those at which the height steps: upright planes above it and the straight borders of what each
// roof plane covers. Cells get their roofs by a graph cut between the samples above them (those on
// planes count fully, others such as leaves a quarter), where a plane goes on far from its samples,
// and the length of the borders; borders in which roofs meet are cheap. Where the ground shows over
// some square metres, as in yards and corners that a map leaves out, cells are outside of the
// building. No roof comes nearer to the ground than `kRaised_m` allows. `planes` are the roofs to
// choose from (indices into evidence.planes), most important first.
RoofCells LabelRoof(const FittedBuilding& building, const RoofEvidence& evidence,
                    std::span<const int> planes, const Tolerances& tolerances);

// The footprint under one level roof.
RoofCells FlatRoof(const MapBuilding& building, double height);

}  // namespace stucco
