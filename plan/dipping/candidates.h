// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "plan/dipping/candidate.h"
#include "plan/dipping/level.h"

namespace stucco::plan {

// Points from which the walls of the level may be captured: a regular grid over the site's area,
// points straight in front of every wall, and, for wall parts that none of these sees, any other
// allowed point that sees them: rays from the wall are followed until they leave the no-dipping
// zone, so that nothing remains hidden that an allowed point could see (to 1.5 degrees). Only
// points that see something are returned.
std::vector<Candidate> FindCandidates(const Level& level, const DippingSetting& setting);

// Sets the reach of the level from what its candidates see, and takes from them what is beyond it.
void LimitReach(const DippingSetting& setting, Level& level, std::vector<Candidate>& candidates);

}  // namespace stucco::plan
