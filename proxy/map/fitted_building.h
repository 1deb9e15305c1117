// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "proxy/map/outlines.h"
#include "survey/geometry2d.h"

namespace stucco {

// An edge of a building's outline where the survey shows it, the building on its left.
struct FittedEdge {
  Segment2d line;
  std::vector<std::string> facades;  // of the plan, the one it has most of first
  bool party = false;                // a neighbour stands against it
  bool fitted = false;               // held by points; else it follows the building
};

struct FittedBuilding {
  MapBuilding building;           // its parts with the fitted corners
  std::vector<FittedEdge> edges;  // by part, ring and corner
  double ground = 0;              // height of its foot
  double held = 0;                // share of its free walls that points hold, by length
};

// The building with other parts, its edges along them. Requires as many corners as it has edges.
FittedBuilding WithParts(FittedBuilding building, std::vector<Polygon> parts);

}  // namespace stucco
