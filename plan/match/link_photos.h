// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "plan/camera/hover.h"
#include "plan/match/ties.h"
#include "plan/space/obstacles.h"
#include "survey/stage.h"

namespace stucco::plan {

// Link photos (ViewKind::kLink) for the photos of facades among `hovers`, before there are any from
// above (plan/match/facade_cover.h): what these are thinned out by then includes the links.
// `hovers` gains shots and, at its end, hovers. Same result at any number of threads. Throws Error
// (kInterrupted).
void LinkFacades(const MatchSetting& setting, const Obstacles& obstacles,
                 std::vector<Hover>& hovers, Progress& progress);

// What the links of a plan come to.
struct LinkReport {
  int photos = 0;
  int stops = 0;  // that they have to themselves
};

// The same for all hovers of a plan, with links or without; besides, links for whatever lacks
// partners, and for groups that one hover alone holds to the rest, or none (plan/match/ties.h), one
// by one, each time the one that serves most for what it costs. Same result at any number of
// threads. Throws Error (kInterrupted).
LinkReport AddLinkPhotos(const MatchSetting& setting, const Obstacles& obstacles,
                         std::vector<Hover>& hovers, Progress& progress);

}  // namespace stucco::plan
