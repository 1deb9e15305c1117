// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include "plan/camera/hover.h"
#include "plan/match/match_stats.h"
#include "plan/match/photo_graph.h"
#include "survey/plan.h"

namespace stucco::plan {

// Fills in the partners of the views of a plan, which are the shots of `hovers` in their order, as
// the photos of the graph are, and says what they come to.
MatchStats ExpectMatches(const PhotoGraph& photos, std::span<const Hover> hovers, int threads,
                         Plan& plan);

}  // namespace stucco::plan
