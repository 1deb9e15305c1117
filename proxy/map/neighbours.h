// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "proxy/map/fitted_building.h"
#include "proxy/map/upright_survey.h"

namespace stucco {

// Lets neighbours meet in one line where the errors of a map draw their walls over each other or
// apart. Nobody sees such a wall but where the higher house rises above the lower one: edges that
// no points hold go to the opposite edge of a neighbour that some do, or half way to one that is
// not held either. Outlines that overlap do so by up to `kMapReach_m`; gaps close only where they
// are no wider than a map of this spread (sigma of its buildings, metres) leaves by mistake, and
// where no ground is seen in them, as it is in alleys.
void MeetNeighbours(const UprightSurvey& survey, double map_sigma_m,
                    std::vector<FittedBuilding>& buildings);

}  // namespace stucco
