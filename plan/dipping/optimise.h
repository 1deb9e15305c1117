// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "plan/dipping/level.h"
#include "plan/dipping/wall_view.h"

namespace stucco::plan {

struct OptimiseReport {
  int rounds = 0;
  int moved = 0;    // point adjustments accepted
  int turned = 0;   // direction adjustments accepted
  int removed = 0;  // views that the others made redundant
};

// Paper, section 4.3: adjusts points, then directions of facades, and removes redundant views, one
// at a time, until nothing changes. A change is accepted when it dominates: the hovering cost of
// the points does not rise, the quality of none of their facades falls, one of these improves, and
// no wall is covered over less of its length. Points without a facade in common do not influence
// each other and are adjusted at the same time; the result does not depend on the number of
// threads.
OptimiseReport OptimiseViews(const Level& level, const DippingSetting& setting,
                             std::vector<double>& turns, std::vector<DippingPoint>& points);

}  // namespace stucco::plan
