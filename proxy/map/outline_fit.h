// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <string>
#include <vector>

#include "proxy/map/registration.h"
#include "proxy/map/upright_survey.h"

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

// Fits the outlines of `buildings` (already where RegisterMap puts them) to the walls in the cloud.
// Maps are digitised one building at a time, and trace eaves or walls: first each building is
// shifted as a whole (neighbours that share a wall together; prior: 0.5 m), together with how far
// all walls stand outside or inside of their outlines, then each run of edges along its normal, to
// where most near-vertical points within 1.5 m lie (the mode of their distances, weighted by how
// far a map is likely to be off; then, of those, where they lie closest together: windows stand
// behind their wall). Edges with too few points move as their building
// and the map do, party walls with the building only, so that neighbours keep touching. An outline
// that would cross itself is only shifted. `ground` is that around the building, else the plan's
// with `plan_to_survey_m` added.
std::vector<FittedBuilding> FitOutlines(const UprightSurvey& survey,
                                        std::span<const MapBuilding> buildings,
                                        std::span<const Facade> facades, double plan_to_survey_m);

// Whether the rings are simple polygons, one inside the other, none touching.
bool IsSimple(const Polygon& polygon);

}  // namespace stucco
