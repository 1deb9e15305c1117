// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "site/site.h"
#include "survey/geometry2d.h"

namespace stucco::plan {

// Beyond this a plan is better made of two.
inline constexpr double kLongestCorridor_m = 500;

// Straight lines over open ground that join the buildings to capture to one whole, where they stand
// farther apart than `gap_m`: those of a shortest tree over their outlines (Prim, "Shortest
// connection networks and some generalizations", 1957) that are longer than that and no longer than
// kLongestCorridor_m.
std::vector<Segment2d> CorridorsOf(const Site& site, double gap_m);

}  // namespace stucco::plan
