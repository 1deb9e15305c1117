// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "plan/match/linked_photos.h"
#include "plan/space/obstacles.h"
#include "survey/stage.h"

namespace stucco::plan {

// Adds link photos until every photo of a facade has the close partners that it should
// (plan/match/ties.h) or no free place is left that gives it one: a greedy set cover (Chvatal, "A
// Greedy Heuristic for the Set-Covering Problem", 1979). What is chosen is a stop, with one or more
// photos that differ by kSameLook_rad or more, by how many partners it gives to photos, of whatever
// facades, for what it costs: hovers that are there, places above them and places of their own, all
// of them from link_candidates. As gains only shrink, a queue of what stops were worth when last
// asked suffices (Minoux, "Accelerated Greedy Algorithms", 1978), and most stops are never looked
// from. Same result at any number of threads. Throws Error (kInterrupted).
void CoverFacades(const Obstacles& obstacles, LinkedPhotos& photos, Progress& progress);

}  // namespace stucco::plan
