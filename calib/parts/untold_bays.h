// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "calib/matching/repeating_walls.h"
#include "calib/scene/scene.h"
#include "survey/plan.h"

namespace stucco {

// Registered photos that may stand a bay or a storey beside their place, ascending: they show
// little but walls that repeat themselves, too few points of anything else hold them on photos of
// which that is not so, and their records do not tell the places apart. First those whose own
// record would rather have another place; then those for which what their records and those of the
// photos that move with them say leaves a doubt of one in twenty. Half of a record's variance is
// taken to be common to neighbours, as in ContradictingGroups. `facades` are those of
// `repeating`, `recorded` the photos' positions by their records, corrected (CorrectedPosition);
// photos without one are not judged. Requires poses in the frame of these.
std::vector<int> UntoldBays(const OnRepeatingWalls& repeating,
                            const std::vector<PlannedFacade>& facades,
                            const std::vector<std::optional<PositionPrior>>& recorded,
                            const Scene& scene);

}  // namespace stucco
