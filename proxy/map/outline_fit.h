// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "proxy/map/fitted_building.h"
#include "proxy/map/registration.h"
#include "proxy/map/upright_survey.h"

namespace stucco {

// Fits the outlines of `buildings` (already where RegisterMap puts them) to the walls in the cloud.
// Maps are digitised one building at a time, and trace eaves or walls: first each building is
// turned and shifted as a whole (neighbours that share a wall together), together with how far all
// walls stand outside or inside of their outlines (map_errors.h), then each run of edges moves
// along its normal, to where most near-vertical points within 1.5 m lie (the mode of their
// distances, weighted by how far a map is likely to be off; then, of those, where they lie closest
// together: windows stand behind their wall). Edges with too few points move as their building and
// the map do, party walls with the building only, so that neighbours keep touching; then neighbours
// meet (neighbours.h). An outline that would cross itself is only moved as a whole. `ground` is
// that around the building, else that of the nearest one, else the plan's with `plan_to_survey_m`
// added.
std::vector<FittedBuilding> FitOutlines(const UprightSurvey& survey,
                                        std::span<const MapBuilding> buildings,
                                        std::span<const Facade> facades, double plan_to_survey_m);

}  // namespace stucco
