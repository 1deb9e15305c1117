// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "plan/camera/hover.h"
#include "plan/match/ties.h"
#include "plan/space/obstacles.h"
#include "survey/stage.h"

namespace stucco::plan {

// What adding links came to.
struct LinkReport {
  int photos = 0;
  int stops = 0;  // that they add
};

// Adds photos (ViewKind::kLink) between those that lack partners (plan/match/ties.h) and the
// others, and between parts of the graph that hang together by one pair or not at all: about the
// geometric mean in distance and half way in direction, at hovers that exist where one will do,
// else in the column above one, which the drone passes anyway, else at places of their own.
// Greedily, the photo first that serves most for what it costs. `hovers` gains shots and, at its
// end, hovers. Same result at any number of threads. Throws Error (kInterrupted).
LinkReport AddLinkPhotos(const MatchSetting& setting, const Obstacles& obstacles,
                         std::vector<Hover>& hovers, Progress& progress);

}  // namespace stucco::plan
