// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "calib/matching/match_photos.h"
#include "calib/matching/shown_walls.h"

namespace stucco {

// Takes matches out that join what photos show of such walls, and pairs that fewer than
// `least_matches` are left of: told by records that are off, some were taken for plain ones.
void DropOnRepeatingWalls(const OnRepeatingWalls& repeating, size_t least_matches,
                          std::vector<VerifiedPair>& pairs);

// What photos show of walls that repeat themselves, matched with what an adjustment knows of their
// poses: within half a period of where these put it, and only where poses are so sure that the next
// bay is a thousand times less likely. A pair whose poses are not keeps what it has: several bays
// look like the right one, and none is chosen. Adds to the first matches, in their order, and
// verifies anew the pairs that it adds to. Returns the number of pairs that it added to.
int MatchAgain(const AgainInput& input, MatchedPairs& matched);

}  // namespace stucco
