// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "plan/dipping/candidates.h"
#include "plan/dipping/wall_view.h"

namespace stucco::plan {

// Paper, section 4.2: every facade gets one viewing direction, the one around its inverse normal
// with which all candidates together would give it the highest quality. Of the terms only Q_s and
// Q_c are asked: a direction changes no distance, and that hundreds of candidates overlap says
// nothing about the few that will stay (with Q_u, directions win that most candidates miss).
// Returns turns (WallView) by facade of the site.
std::vector<double> InitialTurns(const Level& level, const DippingSetting& setting,
                                 std::span<const Candidate> candidates);

// What each candidate would capture. Parts of a facade that are in sight of a candidate but outside
// every field of view in the facade's direction (a wall that is only seen at a slant) get views
// that aim at them, so that what can be seen can also be captured.
std::vector<DippingPoint> ViewsOf(const DippingSetting& setting,
                                  std::span<const Candidate> candidates,
                                  std::span<const double> turns);

}  // namespace stucco::plan
